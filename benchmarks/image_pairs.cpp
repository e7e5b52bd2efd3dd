// SPDX-License-Identifier: Apache-2.0
#include "image_pairs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cairn/features/extractor.h"
#include "cairn/geometry/camera_pose.h"
#include "cairn/geometry/pnp_ransac.h"
#include "cairn/image/codec.h"
#include "cairn/image/registration.h"
#include "cairn/matching/matching.h"
#include "cairn/sequence/given_poses.h"
#include "cairn/sequence/sequence.h"
#include "cairn/simulate/simulate_room.h"
#include "cairn/simulate/simulate_street.h"
#include "features.h"

namespace cairn::bench {
namespace {

using Pixel = Eigen::Vector2d;
using DepthAt = std::function<double(const Pixel&)>;  // metres, 0 where there is none

/// Depth of the nearest pixel, where its neighbours agree: at an outline it could be the wrong side's.
double depth_at(const DepthImage& depth, const Pixel& pixel) {
  constexpr double kMaxJump = 0.05;  // share of the depth
  const int u = static_cast<int>(std::lround(pixel.x())), v = static_cast<int>(std::lround(pixel.y()));
  if (!depth.contains(u - 1, v - 1) || !depth.contains(u + 1, v + 1)) return 0;
  const double centre = static_cast<double>(depth(u, v));
  for (int dv = -1; dv <= 1; ++dv)
    for (int du = -1; du <= 1; ++du)
      if (std::abs(static_cast<double>(depth(u + du, v + dv)) - centre) > kMaxJump * centre) return 0;
  return centre;
}

/// Sum of absolute differences of 11x11 windows, or a large number at the border.
int window_difference(const GrayImage& left, const GrayImage& right, int u, int v, int disparity) {
  constexpr int kHalf = 5;
  constexpr int kOutside = 1 << 20;
  if (!left.contains(u - kHalf, v - kHalf) || !left.contains(u + kHalf, v + kHalf)) return kOutside;
  if (!right.contains(u - disparity - kHalf, v) || !right.contains(u - disparity + kHalf, v)) return kOutside;
  int sum = 0;
  for (int dv = -kHalf; dv <= kHalf; ++dv)
    for (int du = -kHalf; du <= kHalf; ++du)
      sum += std::abs(int{left(u + du, v + dv)} - int{right(u + du - disparity, v + dv)});
  return sum;
}

/// Disparity by block matching around one pixel, with a parabola through the best; 0 where a second place
/// looks nearly as good. It knows no detector, so it favours none.
double block_disparity(const GrayImage& left, const GrayImage& right, const Pixel& pixel) {
  constexpr int kMax = 128;
  constexpr double kUnique = 1.2;
  const int u = static_cast<int>(std::lround(pixel.x())), v = static_cast<int>(std::lround(pixel.y()));
  std::vector<int> cost(kMax + 2);
  for (int d = 0; d < kMax + 2; ++d)
    cost[static_cast<std::size_t>(d)] = window_difference(left, right, u, v, d);
  const auto best = std::min_element(cost.begin() + 1, cost.end() - 1);
  const auto d = best - cost.begin();
  for (auto other = cost.begin(); other != cost.end(); ++other)
    if (std::abs(other - best) > 2 && *other < kUnique * *best) return 0;
  const double before = best[-1], after = best[1], curvature = before - 2.0 * *best + after;
  return static_cast<double>(d) + (curvature > 0 ? (before - after) / (2 * curvature) : 0);
}

std::function<std::optional<Pixel>(const Pixel&)> place_by(const Camera& camera, const DepthAt& depth,
                                                           const Rigid3& second_from_first) {
  return [=](const Pixel& pixel) -> std::optional<Pixel> {
    const double metres = depth(pixel);
    const auto point = metres > 0 ? camera.back_project(pixel, metres) : std::nullopt;
    const auto place = point ? camera.project(second_from_first * *point) : std::nullopt;
    return place && camera.contains(*place) ? place : std::nullopt;
  };
}

/// Pose from the peer's SIFT matches and the first image's depth. two_view comes without poses, and those of
/// redkitchen, made from depth alone with another camera, put a colour pixel 5 px beside its place.
Rigid3 pose_by_peer(const Camera& camera, const GrayImage& first, const GrayImage& second,
                    const DepthAt& depth) {
  constexpr int kCount = 2000;
  constexpr double kVirtualBaseline = 0.1, kSigmaPx = 1;
  const Rig rig{camera.fx, camera.fy, camera.cx, camera.cy, kVirtualBaseline};
  const auto sift = make_extractor({"OPENCV_SIFT", "OPENCV_SIFT", kCount});
  const Features a = sift->extract(first), b = sift->extract(second);
  std::vector<Eigen::Vector3d> points;
  std::vector<Observation> seen;
  for (const Match& match : match_mutual(a.descriptors, b.descriptors)) {
    const Keypoint& from = a.keypoints[static_cast<std::size_t>(match.query)];
    const Keypoint& to = b.keypoints[static_cast<std::size_t>(match.train)];
    const double metres = depth({from.u, from.v});
    if (!(metres > 0)) continue;
    points.push_back(rig.point_at(from.u, from.v, metres));
    Observation observation;
    observation.u = to.u, observation.v = to.v, observation.sigma_px = kSigmaPx;
    seen.push_back(observation);
  }
  const PnpResult pose = solve_pnp_ransac(rig, points, seen, {});
  require(pose.found(), "the two views have a pose");
  return estimate_pose(rig, {points, seen}, pose.camera_from_world).camera_from_world;
}

DepthAt stereo_depth(const Sequence& sequence, const Frame& frame) {
  const double fx_baseline = sequence.calibration.camera.fx * sequence.calibration.baseline.value();
  return [left = frame.gray, right = frame.right, fx_baseline](const Pixel& pixel) {
    const double disparity = block_disparity(left, right, pixel);
    return disparity > 0 ? fx_baseline / disparity : 0;
  };
}

ImagePair pair_of(const Sequence& sequence, std::int64_t first, std::int64_t second,
                  const std::string& group) {
  const FrameLoader loader(sequence);
  const Frame a = loader.load(FrameId{static_cast<std::int32_t>(first)});
  const Frame b = loader.load(FrameId{static_cast<std::int32_t>(second)});
  const Camera& camera = sequence.calibration.camera;
  if (sequence.calibration.baseline) {
    const auto poses = poses_of_frames(sequence, {});
    const auto pose = [&](std::int64_t i) { return poses.at(static_cast<std::size_t>(i)).value(); };
    return {group, a.gray, b.gray,
            place_by(camera, stereo_depth(sequence, a), pose(second).inverse() * pose(first))};
  }
  const DepthAt depth = [image = a.depth](const Pixel& pixel) { return depth_at(image, pixel); };
  return {group, a.gray, b.gray, place_by(camera, depth, pose_by_peer(camera, a.gray, b.gray, depth))};
}

/// The camera of course/two_view; its images come without poses.
Camera two_view_camera() {
  Camera camera;
  camera.width = 640, camera.height = 480;
  camera.fx = 520.9, camera.fy = 521.0, camera.cx = 325.1, camera.cy = 249.7;
  return camera;
}

ImagePair two_view(const std::filesystem::path& folder) {
  constexpr double kUnitsPerMetre = 5000;
  const Camera camera = two_view_camera();
  const GrayImage first = read_gray(folder / "1.png"), second = read_gray(folder / "2.png");
  const DepthAt depth = [image = depth_in_metres(read_depth(folder / "1_depth.png"), kUnitsPerMetre, {0})](
                            const Pixel& pixel) { return depth_at(image, pixel); };
  return {"two_view", first, second, place_by(camera, depth, pose_by_peer(camera, first, second, depth))};
}

void add_sequence_pairs(std::vector<ImagePair>& pairs, const std::filesystem::path& folder,
                        const std::vector<std::int64_t>& starts, const std::vector<std::int64_t>& steps) {
  if (!std::filesystem::exists(folder)) return;
  const Sequence sequence = open_sequence(folder);
  for (const std::int64_t step : steps)
    for (const std::int64_t start : starts)
      if (start + step < static_cast<std::int64_t>(sequence.frames.size()))
        pairs.push_back(pair_of(sequence, start, start + step,
                                fmt::format("{}, {} apart", folder.filename().string(), step)));
}

GrayImage gray_of(const RgbImage& color) {
  GrayImage gray(color.width(), color.height());
  for (std::size_t i = 0; i < color.size(); ++i) {
    const Rgb8& pixel = color.data()[i];
    gray.data()[i] = static_cast<std::uint8_t>((299 * pixel.r + 587 * pixel.g + 114 * pixel.b + 500) / 1000);
  }
  return gray;
}

ImagePair simulated_pair() {
  SimulateRoomOptions options;
  const SimulatedRoom room(options);
  constexpr int kSecond = 10;
  const SimulatedRgbdFrame first = room.render(0), second = room.render(kSecond);
  DepthAt depth = [image = first.depth_true](const Pixel& pixel) { return depth_at(image, pixel); };
  return {
      "simulated room, 10 apart", gray_of(first.color), gray_of(second.color),
      place_by(room.camera(), depth, room.world_from_camera(kSecond).inverse() * room.world_from_camera(0))};
}

}  // namespace

std::vector<ImagePair> load_image_pairs(const std::filesystem::path& data) {
  std::vector<ImagePair> pairs{simulated_pair()};
  if (std::filesystem::exists(data / "course/two_view")) pairs.push_back(two_view(data / "course/two_view"));
  add_sequence_pairs(pairs, data / "rgbd/redkitchen", {50, 150, 250, 350, 450, 550}, {10, 30});
  add_sequence_pairs(pairs, data / "stereo/kitti_0039", {0, 40, 80, 120, 160}, {1});
  return pairs;
}

StereoPair simulate_stereo_pair() {
  SimulateStreetOptions options;
  options.frames_count = 1;
  const SimulatedStreet street(options);
  SimulatedStereoFrame frame = street.render(0);
  return {std::move(frame.left), std::move(frame.right), std::move(frame.depth_true),
          options.camera.fx * options.baseline};
}

Inputs load_inputs(const std::filesystem::path& data) {
  Inputs inputs;
  inputs.pairs = load_image_pairs(data);
  inputs.stereo = simulate_stereo_pair();
  const std::filesystem::path vga = data / "course/two_view/1.png";
  const std::filesystem::path street = data / "stereo/kitti_0039";
  inputs.vga = std::filesystem::exists(vga) ? read_gray(vga) : inputs.pairs.front().first;
  inputs.wide = std::filesystem::exists(street) ? read_gray(open_sequence(street).frames.front().color)
                                                : inputs.stereo.left;
  return inputs;
}

}  // namespace cairn::bench
