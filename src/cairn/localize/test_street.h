// SPDX-License-Identifier: Apache-2.0
// A simulated street and maps of it, for tests and benchmarks.
#pragma once

#include <Eigen/Cholesky>
#include <algorithm>
#include <cstring>
#include <deque>
#include <filesystem>
#include <vector>

#include "cairn/core/random.h"
#include "cairn/localize/localizer.h"
#include "cairn/map/map_writer.h"

namespace cairn::test {

constexpr Rig kRig{500, 500, 319.5, 239.5, 0.4};
constexpr int kWidth = 640, kHeight = 480;

/// A street of points on both sides, seen by a camera that drives along it (x), looking ahead and aside, with
/// descriptors like SIFT's that change a little from view to view.
class World {
 public:
  struct Options {
    std::size_t points = 3000;
    double length = 60;  ///< metres of street
    int keyframes = 40;
    double landmark_sigma = 0.02;  ///< metres across the line of sight; three times as much along it
    double sigma_px = 1;
    std::size_t features = 400;  ///< of a keyframe, at most
    std::uint64_t seed = 1;
  };

  explicit World(const Options& options) : options_(options) {
    Random random(options.seed);
    for (std::size_t i = 0; i < options.points; ++i) {
      const double side = random.uniform() < 0.5 ? -1 : 1;
      points_.emplace_back(random.uniform(0, options.length + 20), side * random.uniform(3, 9),
                           random.uniform(-2.5, 2.5));
    }
    std::sort(points_.begin(), points_.end(),
              [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return a.x() < b.x(); });
  }

  /// Looking along the street, turned to the left by `turn` radians.
  [[nodiscard]] static WorldFromCamera pose_at(double x, double sideways = 0, double turn = 0) {
    Eigen::Matrix3d ahead;  // camera x: right (-y in the world), y: down (-z), z: along x
    ahead << 0, 0, 1, -1, 0, 0, 0, -1, 0;
    return WorldFromCamera({rotation_exp({0, 0, turn}) * Eigen::Quaterniond(ahead), {x, sideways, 0}});
  }

  /// What a camera sees.
  struct View {
    ObservedFrame frame;
    std::vector<std::size_t> points;  ///< of each feature
  };
  /// At most `most` points up to 25 m away, with noise, with or without disparities.
  [[nodiscard]] View see(const WorldFromCamera& world_from_camera, std::uint64_t stream, bool stereo,
                         std::size_t most) const {
    Random random(options_.seed + 1000, stream);
    View view;
    view.points = visible(world_from_camera, most);
    view.frame.frame = {static_cast<std::int32_t>(stream)};
    view.frame.stamp_ns = static_cast<std::int64_t>(stream) * 100'000'000;
    view.frame.features.descriptors = Descriptors(Norm::l2, kBytes, view.points.size());
    const CameraFromWorld camera_from_world = world_from_camera.inverse();
    for (std::size_t i = 0; i < view.points.size(); ++i) {
      add_feature(camera_from_world * points_[view.points[i]], stereo, random, view.frame);
      put_look(view.points[i], random, view.frame.features.descriptors.row(i));
    }
    return view;
  }
  [[nodiscard]] View see(const WorldFromCamera& pose, std::uint64_t stream, bool stereo) const {
    return see(pose, stream, stereo, options_.features);
  }

  /// Landmarks seen twice at least, each off by as much as its covariance says.
  void write_map(const std::filesystem::path& folder) const {
    MapHeader header;
    header.rig = kRig;
    header.width = kWidth;
    header.height = kHeight;
    header.descriptor = {"SIFT", Norm::l2, kBytes};
    std::filesystem::create_directories(folder);
    MapWriter writer(folder, header);
    const std::vector<LandmarkId> ids = number_landmarks();
    Random random(options_.seed + 2000);
    std::deque<KeyframeView> window;  // those that may show what is not finished yet
    std::size_t finished = 0;
    for (int k = 0; k < options_.keyframes; ++k) {
      window.push_back({{k}, keyframe_pose(k), see(keyframe_pose(k), static_cast<std::uint64_t>(k), true)});
      const KeyframeView& now = window.back();
      std::vector<LandmarkId> shown;
      for (const std::size_t point : now.view.points) shown.push_back(ids[point]);
      writer.add_frame(now.view.frame, shown, now.world_from_camera);
      const double passed = now.world_from_camera.translation.x() - 10;
      for (; finished < points_.size() && points_[finished].x() < passed; ++finished)
        if (ids[finished].valid()) writer.add_landmark(landmark(finished, window, random));
      while (window.front().world_from_camera.translation.x() < passed - 40) window.pop_front();
    }
    for (; finished < points_.size(); ++finished)
      if (ids[finished].valid()) writer.add_landmark(landmark(finished, window, random));
    writer.finish();
    MapWriter::discard_spools(folder);
  }

 private:
  static constexpr std::size_t kBytes = 128;
  struct KeyframeView {
    KeyframeId id;
    WorldFromCamera world_from_camera;
    View view;
  };

  [[nodiscard]] WorldFromCamera keyframe_pose(int k) const {
    return pose_at(options_.length * k / options_.keyframes, 0, k % 2 == 0 ? 0.15 : -0.15);
  }

  [[nodiscard]] std::vector<std::size_t> visible(const WorldFromCamera& world_from_camera,
                                                 std::size_t most) const {
    constexpr double kFarthest = 25;
    const double x = world_from_camera.translation.x();
    const auto begin =
        std::lower_bound(points_.begin(), points_.end(), x - kFarthest,
                         [](const Eigen::Vector3d& point, double at) { return point.x() < at; });
    std::vector<std::size_t> found;
    const CameraFromWorld camera_from_world = world_from_camera.inverse();
    for (auto point = begin; point != points_.end() && point->x() < x + kFarthest; ++point) {
      const Eigen::Vector3d in_camera = camera_from_world * *point;
      if (in_camera.z() < 1 || in_camera.z() > kFarthest) continue;
      const Eigen::Vector3d pixel = kRig.project(in_camera);
      if (pixel.x() < 0 || pixel.x() > kWidth - 1 || pixel.y() < 0 || pixel.y() > kHeight - 1) continue;
      found.push_back(static_cast<std::size_t>(point - points_.begin()));
    }
    if (found.size() <= most) return found;
    std::vector<std::size_t> some;  // spread over the distances
    for (std::size_t i = 0; i < most; ++i) some.push_back(found[i * found.size() / most]);
    return some;
  }

  void add_feature(const Eigen::Vector3d& point_in_camera, bool stereo, Random& random,
                   ObservedFrame& frame) const {
    constexpr double kSigmaDisparity = 0.5, kSmallest = 0.5;
    const Eigen::Vector3d pixel = kRig.project(point_in_camera);
    Observation seen;
    seen.u = pixel.x() + options_.sigma_px * random.normal();
    seen.v = pixel.y() + options_.sigma_px * random.normal();
    seen.sigma_px = options_.sigma_px;
    seen.sigma_d_px = kSigmaDisparity;
    if (stereo) seen.d = std::max(kSmallest, pixel.z() + kSigmaDisparity * random.normal());
    frame.observations.push_back(seen);
    frame.points_in_camera.push_back(point_in_camera);
    frame.features.keypoints.push_back({static_cast<float>(seen.u), static_cast<float>(seen.v),
                                        static_cast<float>(300 / point_in_camera.z()), 0, 0,
                                        static_cast<float>(options_.sigma_px)});
  }

  /// The point's own look and the view's noise.
  void put_look(std::size_t point, Random& of_view, std::uint8_t* row) const {
    Random of_point(options_.seed + 3000, point);
    for (std::size_t b = 0; b < kBytes; b += 8) {
      const std::uint64_t look = of_point.next(), noise = of_view.next();
      for (std::size_t k = 0; k < 8; ++k)
        row[b + k] = static_cast<std::uint8_t>(((look >> (8 * k)) & 63U) + ((noise >> (8 * k)) & 15U));
    }
  }

  /// Points that are seen twice become landmarks, in their order.
  [[nodiscard]] std::vector<LandmarkId> number_landmarks() const {
    std::vector<int> sightings(points_.size(), 0);
    for (int k = 0; k < options_.keyframes; ++k)
      for (const std::size_t point : visible(keyframe_pose(k), options_.features)) ++sightings[point];
    std::vector<LandmarkId> ids(points_.size());
    std::int32_t next = 0;
    for (std::size_t i = 0; i < ids.size(); ++i)
      if (sightings[i] >= 2) ids[i] = {next++};
    return ids;
  }

  [[nodiscard]] FinishedLandmark landmark(std::size_t point, const std::deque<KeyframeView>& window,
                                          Random& random) const {
    FinishedLandmark result;
    std::vector<LandmarkView> seen;
    std::vector<const std::uint8_t*> rows;
    for (const KeyframeView& keyframe : window) {
      const auto& points = keyframe.view.points;
      const auto place = std::lower_bound(points.begin(), points.end(), point);
      if (place == points.end() || *place != point) continue;
      const auto feature = static_cast<std::size_t>(place - points.begin());
      const ObservedFrame& frame = keyframe.view.frame;
      result.sightings.push_back({keyframe.id, static_cast<std::int32_t>(feature)});
      result.keypoints.push_back(frame.features.keypoints[feature]);
      rows.push_back(frame.features.descriptors.row(feature));
      seen.push_back({keyframe.world_from_camera.inverse(), frame.observations[feature]});
    }
    result.descriptors = Descriptors(Norm::l2, kBytes, rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) std::memcpy(result.descriptors.row(i), rows[i], kBytes);
    displace(point, seen.front().camera_from_world, random, result);
    result.indicators = indicators_of(kRig, result.point_in_world, seen);
    return result;
  }

  void displace(std::size_t point, const CameraFromWorld& camera_from_world, Random& random,
                FinishedLandmark& landmark) const {
    const Eigen::Vector3d along = (points_[point] - camera_from_world.inverse().translation).normalized();
    const double variance = options_.landmark_sigma * options_.landmark_sigma;
    const Eigen::Matrix3d covariance =
        variance * (Eigen::Matrix3d::Identity() + 8 * along * along.transpose());
    landmark.covariance = 0.5 * (covariance + covariance.transpose());
    landmark.point_in_world = points_[point];
    if (variance == 0) return;
    const Eigen::Vector3d noise(random.normal(), random.normal(), random.normal());
    landmark.point_in_world += Eigen::Matrix3d(landmark.covariance.llt().matrixL()) * noise;
  }

  Options options_;
  std::vector<Eigen::Vector3d> points_;  // by x
};

inline QueryCamera query_camera() {
  return {kRig, kWidth, kHeight};
}

}  // namespace cairn::test
