// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/recorded_poses.h"

#include <fmt/format.h>

#include "cairn/core/error.h"
#include "cairn/core/file.h"
#include "cairn/sequence/formats.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;

/// By its content: names of columns first, then how many values a line has.
RecordedPoses read_text(const fs::path& path, bool may_have_numbers) {
  if (is_sbet(path)) return read_sbet(path);
  if (is_novatel(path)) return read_novatel(path);
  expect_text(path, read_file(path));
  if (const auto header = find_table_header(path)) {
    return names_quaternions(*header) ? read_quaternion_table(path, *header, may_have_numbers)
                                      : read_pose_table(path, *header);
  }
  return read_unnamed_poses(path, may_have_numbers);
}

RecordedPoses read_folder(const fs::path& folder, bool may_have_numbers) {
  if (is_oxts(folder)) return read_oxts(folder);
  if (const auto oxts = oxts_in(folder)) return read_oxts(*oxts);
  for (const char* name : {"data.csv", "trajectory.txt"})
    if (fs::exists(folder / name)) return read_text(folder / name, may_have_numbers);
  throw InputError({folder.string(), 0,
                    "poses: OXTS packets (data/ and timestamps.txt), a data.csv as EuRoC's, or a run's "
                    "trajectory.txt",
                    "a folder without them", "Name the file or the folder that holds the poses."});
}

}  // namespace

RecordedPoses read_recorded_poses(const fs::path& path, bool may_have_numbers) {
  return fs::is_directory(path) ? read_folder(path, may_have_numbers) : read_text(path, may_have_numbers);
}

RecordedPoses poses_of_trajectory(const Trajectory& trajectory) {
  RecordedPoses recorded;
  for (const StampedPose& pose : trajectory)
    recorded.poses.push_back(recorded_pose(pose.stamp_ns, pose.world_from_camera));
  return recorded;
}

Eigen::Matrix3d covariance_of(const Eigen::Vector3d& standard_deviations) {
  return standard_deviations.cwiseAbs2().asDiagonal();
}

}  // namespace cairn
