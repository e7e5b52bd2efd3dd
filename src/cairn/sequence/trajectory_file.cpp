// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/trajectory_file.h"

#include <fmt/format.h>

#include <map>

#include "cairn/core/error.h"
#include "cairn/sequence/formats.h"
#include "cairn/sequence/geodetic.h"
#include "cairn/sequence/recorded_poses.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;

RecordedPoses read_checked(const fs::path& path, bool may_have_numbers) {
  try {
    return read_recorded_poses(path, may_have_numbers);
  } catch (const fs::filesystem_error& error) {
    throw InputError({error.path1().string(), 0, "a readable file or folder", error.code().message(),
                      "Check the path and its permissions."});
  }
}

void expect_stamps(const fs::path& path, const TrajectoryFile& file) {
  if (file.key == PoseKey::stamp) return;
  throw InputError({path.string(), 0, "poses with time stamps, t tx ty tz qx qy qz qw a line",
                    fmt::format("poses without ({})", file.format), "Write the file in TUM format."});
}

}  // namespace

TrajectoryFile read_trajectory_file(const fs::path& path, const TrajectoryFileOptions& options) {
  RecordedPoses recorded = read_checked(path, options.may_have_numbers);
  TrajectoryFile file;
  if (recorded.geodetic) {
    const Eigen::Vector3d& first = recorded.poses.front().place;
    file.origin = options.origin.value_or(GeodeticOrigin{first.x(), first.y(), first.z()});
    move_to_origin(*file.origin, recorded);
  }
  file.key = recorded.key;
  file.first_key = recorded.first_key.value_or(recorded.poses.front().key);
  file.is_of_body = recorded.subject != PoseSubject::camera && recorded.subject != PoseSubject::not_stated;
  file.format = recorded.format;
  file.warnings = recorded.warnings;
  file.poses.reserve(recorded.poses.size());
  for (const RecordedPose& pose : recorded.poses)
    file.poses.push_back({pose.key, WorldFromCamera({pose.rotation, pose.place})});
  return file;
}

bool is_pose_folder(const fs::path& folder) {
  std::error_code ignored;
  return is_oxts(folder) || oxts_in(folder) || fs::exists(folder / "data.csv", ignored);
}

void stamp_by_frames(const fs::path& path, const std::vector<std::int64_t>& numbers,
                     const std::vector<std::int64_t>& stamps, TrajectoryFile& file) {
  require(numbers.size() == stamps.size(), "each frame has a number and a stamp");
  if (file.key == PoseKey::stamp) return;
  if (file.key == PoseKey::position && file.poses.size() != stamps.size()) {
    throw InputError({path.string(), 0, fmt::format("{} poses, one for each frame", stamps.size()),
                      fmt::format("{}", file.poses.size()),
                      "Add or delete lines, or give the poses with time stamps (TUM format)."});
  }
  std::map<std::int64_t, std::int64_t> stamp_of;
  for (std::size_t i = 0; i < stamps.size(); ++i)
    stamp_of[file.key == PoseKey::position ? static_cast<std::int64_t>(i) : numbers[i]] = stamps[i];
  Trajectory stamped;
  for (const StampedPose& pose : file.poses) {
    const auto found = stamp_of.find(pose.stamp_ns);
    if (found != stamp_of.end()) stamped.push_back({found->second, pose.world_from_camera});
  }
  if (stamped.empty()) {
    throw InputError({path.string(), 0, "poses of the sequence's frame numbers", "none",
                      "Check that the poses belong to this sequence."});
  }
  file.poses = std::move(stamped);
  file.first_key = file.poses.front().stamp_ns;
  file.key = PoseKey::stamp;
}

Trajectory read_truth(const fs::path& path, bool is_of_body, SequenceReport& report) {
  TrajectoryFile file = read_trajectory_file(path);
  expect_stamps(path, file);
  if (file.is_of_body && !is_of_body) {
    throw InputError({path.string(), 0, "poses of the camera, as a sequence carries them",
                      fmt::format("poses of a body ({})", file.format),
                      "Move the file elsewhere and give it with --poses."});
  }
  report.warnings.insert(report.warnings.end(), file.warnings.begin(), file.warnings.end());
  return std::move(file.poses);
}

Trajectory read_tum_trajectory(const fs::path& path) {
  TrajectoryFile file = read_trajectory_file(path);
  expect_stamps(path, file);
  return std::move(file.poses);
}

}  // namespace cairn
