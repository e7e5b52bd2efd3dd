// SPDX-License-Identifier: Apache-2.0
// The KITTI odometry benchmark's layout (Geiger et al. 2012): images of the left and right camera, rectified,
// grey in image_0 and image_1 or in colour in image_2 and image_3; calib.txt with the 3x4 projection matrices
// P0 to P3; times.txt, seconds; poses.txt, where there is one, 3x4 world_from_camera of camera 0 by rows.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <set>

#include "cairn/core/error.h"
#include "cairn/core/text.h"
#include "cairn/sequence/formats.h"
#include "cairn/sequence/trajectory_file.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;
using Projection = std::array<double, 12>;  ///< 3x4 by rows

/// Names the folders of a pair and the lines of calib.txt that are of it.
struct Pair {
  const char *left, *right, *left_projection, *right_projection;
};
constexpr Pair kGrey{"image_0", "image_1", "P0:", "P1:"}, kColor{"image_2", "image_3", "P2:", "P3:"};

/// Returns the pair that a folder holds, the grey one if both.
const Pair& pair_in(const fs::path& folder) {
  return fs::is_directory(folder / kGrey.left) || !fs::is_directory(folder / kColor.left) ? kGrey : kColor;
}

std::vector<fs::path> images_in(const fs::path& folder) {
  if (!fs::is_directory(folder)) {
    throw InputError(
        {folder.string(), 0, "a folder with the images of one camera", "none",
         "KITTI's stereo pairs lie in image_0 (left) and image_1 (right), in colour in image_2 and "
         "image_3."});
  }
  std::vector<fs::path> images;
  for (const fs::path& file : files_in(folder))
    if (is_image_name(file)) images.push_back(file);
  return images;
}

/// File names in natural order, each once.
struct NaturalOrder {
  bool operator()(const std::string& a, const std::string& b) const { return comes_naturally_before(a, b); }
};
using Names = std::set<std::string, NaturalOrder>;

Names names_of(const std::vector<fs::path>& images) {
  Names names;
  for (const fs::path& image : images) names.insert(image.filename().string());
  return names;
}

/// The first name that only one of the cameras has.
[[noreturn]] void fail_lone(const Names& left, const Names& right, const Pair& pair, const fs::path& folder) {
  Names lone;
  std::set_symmetric_difference(left.begin(), left.end(), right.begin(), right.end(),
                                std::inserter(lone, lone.end()), NaturalOrder());
  const std::string& name = *lone.begin();
  const char* const has = left.contains(name) ? pair.left : pair.right;
  const char* const lacks = left.contains(name) ? pair.right : pair.left;
  throw InputError({(folder / lacks / name).string(), 0,
                    fmt::format("the partner of {}", (folder / has / name).string()), "no such file",
                    "Delete the lone image and its lines in times.txt and poses.txt, or add the other."});
}

/// The names 000000.png ... of `count` pairs, of which some are missing on disk: where all names there are
/// positions among them. Nothing otherwise.
/// Names the empty places of a list by their number, as `pattern` is.
void fill_places(const fs::path& pattern, std::vector<std::string>& by_position) {
  for (std::size_t i = 0; i < by_position.size(); ++i) {
    if (by_position[i].empty())
      by_position[i] =
          fmt::format("{:0{}}{}", i, pattern.stem().string().size(), pattern.extension().string());
  }
}

std::optional<Names> names_by_position(const Names& names, std::size_t count) {
  std::vector<std::string> by_position(count);
  for (const std::string& name : names) {
    const auto position = parse_frame_number(fs::path(name).stem().string());
    if (!position || *position >= static_cast<std::int64_t>(count)) return std::nullopt;
    std::string& place = by_position[static_cast<std::size_t>(*position)];
    if (!place.empty()) return std::nullopt;
    place = name;
  }
  fill_places(*names.begin(), by_position);
  return Names(by_position.begin(), by_position.end());
}

/// The file names of all pairs that times.txt lists. A file that is missing on disk is one that cannot be
/// read like any other; but where the times do not say that it was there, one does not know which time is
/// whose.
Names names_of_pairs(const Names& left, const Names& right, std::size_t times, const Pair& pair,
                     const fs::path& folder) {
  Names names = left;
  names.insert(right.begin(), right.end());
  if (right.empty()) fail_lone(left, right, pair, folder);
  if (names.size() == times) return names;
  if (auto all = names_by_position(names, times); names.size() < times && all) return *all;
  if (left != right) fail_lone(left, right, pair, folder);
  throw InputError({(folder / "times.txt").string(), 0,
                    fmt::format("{} times, one for each image in {}", left.size(), pair.left),
                    fmt::format("{}", times), "Add or delete lines, or images."});
}

Projection read_projection(const TextFile& file, std::string_view name) {
  for (const TextLine& line : file.lines()) {
    if (line.fields[0] != name) continue;
    file.expect_fields(line, 13, fmt::format("{} and a 3x4 matrix by rows", name));
    Projection p{};
    for (std::size_t i = 0; i < p.size(); ++i) p[i] = file.number(line, i + 1, name);
    return p;
  }
  throw InputError({file.path().string(), 0, fmt::format("a line '{} ...'", name), "none",
                    "It holds the 3x4 projection matrix of that camera by rows."});
}

/// Returns the translation from camera 0 to the camera of a projection K [I | t], metres.
Eigen::Vector3d translation_of(const Projection& p) {
  return {(p[3] - p[2] * p[11]) / p[0], (p[7] - p[6] * p[11]) / p[5], p[11]};
}

/// Reads the pair's camera and baseline. Returns camera_from_camera0, a translation.
Rigid3 read_rig(const fs::path& path, const Pair& pair, Calibration& calibration) {
  const TextFile file(path);
  const Projection left = read_projection(file, pair.left_projection),
                   right = read_projection(file, pair.right_projection);
  const std::string left_name(pair.left_projection, 2), right_name(pair.right_projection, 2);
  const auto fail = [&](std::string expected, double found) {
    throw InputError({path.string(), 0, std::move(expected), fmt::format("{}", found), "Check calib.txt."});
  };
  Camera& camera = calibration.camera;
  camera.fx = left[0];
  camera.fy = left[5];
  camera.cx = left[2];
  camera.cy = left[6];
  for (const double focal_length : {camera.fx, camera.fy})
    if (!(focal_length > 0)) fail("a focal length above 0 in " + left_name, focal_length);
  constexpr std::array<std::size_t, 4> kIntrinsics{0, 2, 5, 6};
  for (const std::size_t i : kIntrinsics) {
    if (std::abs(left[i] - right[i]) > 1e-3)
      fail(fmt::format("{} with the focal lengths and centre of {} (rectified images): {}", right_name,
                       left_name, left[i]),
           right[i]);
  }
  const double baseline = translation_of(left).x() - translation_of(right).x();
  if (!(baseline > 0)) fail("the right camera to the right of the left one, a baseline above 0 m", baseline);
  calibration.baseline = baseline;
  return {Eigen::Quaterniond::Identity(), translation_of(left)};
}

std::int64_t read_time(const TextFile& file, const TextLine& line) {
  file.expect_fields(line, 1, "seconds");
  std::int64_t stamp_ns = 0;
  if (!parse_stamp(line.fields[0], stamp_ns))
    file.fail(line, "a time in seconds", fmt::format("'{}'", line.fields[0]), "Correct the line.");
  return stamp_ns;
}

std::vector<std::int64_t> read_times(const fs::path& path) {
  const TextFile file(path);
  std::vector<std::int64_t> stamps;
  for (const TextLine& line : file.lines()) {
    const std::int64_t stamp_ns = read_time(file, line);
    if (!stamps.empty() && stamp_ns <= stamps.back()) {
      file.fail(line, fmt::format("a time after {}", format_stamp(stamps.back())), format_stamp(stamp_ns),
                "Sort the times; each image needs its own.");
    }
    stamps.push_back(stamp_ns);
  }
  return stamps;
}

/// Moves poses of camera 0 to the left camera of the pair.
void move_to_camera(const Rigid3& camera_from_camera0, Trajectory& poses) {
  if (camera_from_camera0.translation.isZero(0)) return;  // the bits stay
  for (StampedPose& pose : poses)
    pose.world_from_camera = WorldFromCamera(pose.world_from_camera * camera_from_camera0.inverse());
}

/// Reads a pose of camera 0 for each image, or poses of the left camera with stamps of their own.
Trajectory read_poses(const fs::path& path, const std::vector<std::int64_t>& stamps,
                      const Rigid3& camera_from_camera0, SequenceReport& report) {
  const TextFile text(path);
  constexpr std::size_t kLeast = 8;  // of any other layout
  const bool is_short = !text.lines().empty() && text.lines().front().fields.size() < kLeast;
  double value = 0;
  if (is_short && parse_number(text.lines().front().fields[0], value))
    (void)parse_matrix_pose(text, text.lines().front());  // says what is expected
  TrajectoryFile file = read_trajectory_file(path);
  if (file.key == PoseKey::stamp) return read_truth(path, false, report);
  if (file.poses.size() != stamps.size()) {
    throw InputError({path.string(), 0, fmt::format("{} poses, one for each image", stamps.size()),
                      fmt::format("{}", file.poses.size()), "Add or delete lines, or remove the file."});
  }
  for (std::size_t i = 0; i < stamps.size(); ++i) file.poses[i].stamp_ns = stamps[i];
  move_to_camera(camera_from_camera0, file.poses);
  return std::move(file.poses);
}

/// Reads the calibration that the format carries. Returns camera_from_camera0.
Rigid3 read_calib(const fs::path& path, const Pair& pair, const std::vector<fs::path>& images,
                  Calibration& calibration) {
  Rigid3 camera_from_camera0 = read_rig(path, pair, calibration);
  const ImageSize size = size_of_images(images);
  calibration.camera.width = size.width;
  calibration.camera.height = size.height;
  return camera_from_camera0;
}

}  // namespace

bool is_kitti(const fs::path& folder) {
  return fs::is_directory(folder / pair_in(folder).left) &&
         (fs::exists(folder / "calib.txt") || fs::exists(folder / "times.txt"));
}

void list_kitti(const fs::path& folder, Sequence& sequence) {
  sequence.format = "KITTI";
  const Pair& pair = pair_in(folder);
  const auto left = images_in(folder / pair.left), right = images_in(folder / pair.right);
  if (left.empty()) {
    throw InputError({(folder / pair.left).string(), 0, "PNG or JPEG images", "none", "Check the folder."});
  }
  const auto stamps = read_times(folder / "times.txt");
  const Names left_names = names_of(left), right_names = names_of(right);
  for (const std::string& name : names_of_pairs(left_names, right_names, stamps.size(), pair, folder)) {
    if (left_names.contains(name) && right_names.contains(name)) ++sequence.report.associated;
    const std::size_t i = sequence.frames.size();
    const auto number = parse_frame_number(fs::path(name).stem().string());
    sequence.frames.push_back({stamps[i],
                               number.value_or(static_cast<std::int64_t>(i)),
                               folder / pair.left / name,
                               {},
                               folder / pair.right / name});
  }
  Rigid3 camera_from_camera0;
  if (sequence.calibration_source.empty()) {
    camera_from_camera0 = read_calib(folder / "calib.txt", pair, left, sequence.calibration);
    sequence.calibration_source = (folder / "calib.txt").string();
  }
  if (fs::exists(folder / "poses.txt"))
    sequence.truth = read_poses(folder / "poses.txt", stamps, camera_from_camera0, sequence.report);
  sequence.report.color_images = static_cast<std::int64_t>(left.size());
  sequence.report.right_images = static_cast<std::int64_t>(right.size());
}

}  // namespace cairn
