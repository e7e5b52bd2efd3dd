// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/recorded_poses.h"

#include <fmt/format.h>

#include "cairn/core/error.h"
#include "cairn/sequence/formats.h"
#include "cairn/sequence/pose_collector.h"
#include "cairn/sequence/table_row.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;

RecordedPose recorded_pose(std::int64_t key, const Rigid3& world_from_subject) {
  RecordedPose pose;
  pose.key = key;
  pose.place = world_from_subject.translation;
  pose.rotation = world_from_subject.rotation;
  return pose;
}

RecordedPoses empty_poses(const fs::path& source, const char* format) {
  RecordedPoses recorded;
  recorded.source = source;
  recorded.format = format;
  return recorded;
}

RecordedPoses read_tum(const fs::path& path, bool may_have_numbers) {
  constexpr std::string_view kLayout = "t tx ty tz qx qy qz qw";
  constexpr std::int64_t kSecondNs = 1'000'000'000;  // a whole number was read as seconds
  RecordedPoses recorded = empty_poses(path, "TUM");
  const TextFile file(path);
  std::vector<std::string_view> stamps;
  for (const TextLine& line : file.lines()) stamps.push_back(line.fields.front());
  const TimeUnit unit = infer_time_unit(stamps);
  const bool has_numbers = may_have_numbers && has_frame_numbers(path);
  if (has_numbers) recorded.key = PoseKey::number;
  PoseCollector collector(recorded);
  for (const TextLine& line : file.lines()) {
    file.expect_fields(line, 8, kLayout);
    const auto [stamp_ns, pose] = parse_tum_pose(file, line, 0, unit);
    collector.add(file, line, recorded_pose(has_numbers ? stamp_ns / kSecondNs : stamp_ns, pose));
  }
  if (recorded.poses.empty()) {
    throw InputError({path.string(), 0, fmt::format("poses, one a line: {}", kLayout), "none",
                      "Check that this is the right file."});
  }
  collector.finish();
  return recorded;
}

RecordedPoses read_kitti(const TextFile& file) {
  RecordedPoses recorded = empty_poses(file.path(), "KITTI");
  recorded.key = PoseKey::position;
  for (const TextLine& line : file.lines()) {
    const auto position = static_cast<std::int64_t>(recorded.poses.size());
    recorded.poses.push_back(recorded_pose(position, parse_matrix_pose(file, line)));
  }
  return recorded;
}

/// By its content: names of columns first, then how many values a line has.
RecordedPoses read_text(const fs::path& path, bool may_have_numbers) {
  if (is_sbet(path)) return read_sbet(path);
  if (is_novatel(path)) return read_novatel(path);
  if (const auto header = find_table_header(path)) {
    return names_quaternions(*header) ? read_quaternion_table(path, *header, may_have_numbers)
                                      : read_pose_table(path, *header);
  }
  if (separator_of_rows(path) == Separator::commas) return read_unnamed_asl_poses(path);
  constexpr std::size_t kMatrix = 12;
  const TextFile file(path);
  const bool is_kitti = !file.lines().empty() && file.lines().front().fields.size() == kMatrix;
  return is_kitti ? read_kitti(file) : read_tum(path, may_have_numbers);
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
