// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/recorded_poses.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cairn/core/error.h"
#include "cairn/sequence/asl_poses.h"
#include "cairn/sequence/formats.h"

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
  constexpr std::int64_t kSecondNs = 1'000'000'000;  // a whole number was read as seconds
  RecordedPoses recorded = poses_of_trajectory(read_tum_trajectory(path));
  recorded.source = path;
  recorded.format = "TUM";
  if (!may_have_numbers || !has_frame_numbers(path)) return recorded;
  recorded.key = PoseKey::number;
  for (RecordedPose& pose : recorded.poses) pose.key /= kSecondNs;
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

RecordedPoses read_asl(const fs::path& path) {
  RecordedPoses recorded = empty_poses(path, "EuRoC");
  recorded.subject = PoseSubject::body_of_sensor;
  for (const auto& [stamp_ns, world_from_body] : read_asl_poses(path))
    recorded.poses.push_back(recorded_pose(stamp_ns, world_from_body));
  return recorded;
}

RecordedPoses read_folder(const fs::path& folder) {
  if (is_oxts(folder)) return read_oxts(folder);
  if (const auto oxts = oxts_in(folder)) return read_oxts(*oxts);
  if (fs::exists(folder / "data.csv")) return read_asl(folder / "data.csv");
  throw InputError({folder.string(), 0,
                    "poses: OXTS packets (data/ and timestamps.txt), or a data.csv as EuRoC's",
                    "a folder without them", "Name the file or the folder that holds the poses."});
}

RecordedPoses read_text(const fs::path& path, bool may_have_numbers) {
  const TextFile file(path);
  if (file.lines().empty()) return read_tum(path, may_have_numbers);
  const auto& fields = file.lines().front().fields;
  const bool has_commas = std::any_of(fields.begin(), fields.end(), [](std::string_view field) {
    return field.find(',') != std::string_view::npos;
  });
  if (has_commas) return is_pose_table(path) ? read_pose_table(path) : read_asl(path);
  constexpr std::size_t kMatrix = 12;
  return fields.size() == kMatrix ? read_kitti(file) : read_tum(path, may_have_numbers);
}

}  // namespace

RecordedPoses read_recorded_poses(const fs::path& path, bool may_have_numbers) {
  return fs::is_directory(path) ? read_folder(path) : read_text(path, may_have_numbers);
}

RecordedPoses poses_of_trajectory(const Trajectory& trajectory) {
  RecordedPoses recorded;
  for (const StampedPose& pose : trajectory)
    recorded.poses.push_back(recorded_pose(pose.stamp_ns, pose.world_from_camera));
  return recorded;
}

void append_pose(const TextFile& file, const TextLine& line, const RecordedPose& pose,
                 RecordedPoses& recorded) {
  if (recorded.poses.empty() || pose.key > recorded.poses.back().key) {
    recorded.poses.push_back(pose);
    return;
  }
  const bool by_time = recorded.key == PoseKey::stamp;
  const auto describe = [&](std::int64_t key) {
    return by_time ? format_stamp(key) : fmt::format("{}", key);
  };
  file.fail(line,
            fmt::format("a {} after {}", by_time ? "time stamp" : "frame number",
                        describe(recorded.poses.back().key)),
            describe(pose.key), "Sort the file and remove double lines.");
}

Eigen::Matrix3d covariance_of(const Eigen::Vector3d& standard_deviations) {
  return standard_deviations.cwiseAbs2().asDiagonal();
}

}  // namespace cairn
