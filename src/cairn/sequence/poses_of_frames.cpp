// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "cairn/core/error.h"
#include "cairn/sequence/association.h"
#include "cairn/sequence/formats.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;
using PosesOfFrames = std::vector<std::optional<WorldFromCamera>>;

PosesOfFrames poses_by_time(const Sequence& sequence, const Trajectory& trajectory, double max_gap_s) {
  std::vector<std::int64_t> frame_stamps, pose_stamps;
  for (const FrameFiles& files : sequence.frames) frame_stamps.push_back(files.stamp_ns);
  for (const StampedPose& pose : trajectory) pose_stamps.push_back(pose.stamp_ns);
  PosesOfFrames poses(sequence.frames.size());
  for (const auto& [frame, pose] :
       associate_stamps(frame_stamps, pose_stamps, std::llround(max_gap_s * 1e9))) {
    poses[frame] = trajectory[pose].world_from_camera;
  }
  return poses;
}

/// The stamps are frame numbers, read as seconds.
PosesOfFrames poses_by_number(const Sequence& sequence, const Trajectory& trajectory) {
  std::map<std::int64_t, WorldFromCamera> pose_of_number;
  for (const StampedPose& pose : trajectory)
    pose_of_number[pose.stamp_ns / 1'000'000'000] = pose.world_from_camera;
  PosesOfFrames poses;
  for (const FrameFiles& files : sequence.frames) {
    const auto found = pose_of_number.find(files.number);
    poses.push_back(found == pose_of_number.end() ? std::nullopt : std::optional(found->second));
  }
  return poses;
}

PosesOfFrames expect_some(PosesOfFrames poses, const fs::path& file, std::string expected) {
  if (std::any_of(poses.begin(), poses.end(), [](const auto& pose) { return pose.has_value(); }))
    return poses;
  throw InputError({file.string(), 0, std::move(expected), "none",
                    "Check that the poses belong to this sequence and share its clock."});
}

}  // namespace

PosesOfFrames poses_of_frames(const Sequence& sequence, const fs::path& path, double max_gap_s) {
  const auto within = [](double gap_s) { return fmt::format("poses within {} s of the frames", gap_s); };
  // elsewhere poses and frames have the same stamps
  const bool has_clock = sequence.format == "TUM" || sequence.format == "EuRoC";
  if (path.empty()) {
    if (!sequence.truth) {
      throw InputError({sequence.folder.string(), 0, "poses", "a sequence that carries none",
                        "Give --poses FILE (TUM format)."});
    }
    const double gap_s = has_clock ? max_gap_s : 0.0;
    return expect_some(poses_by_time(sequence, *sequence.truth, gap_s), sequence.folder, within(gap_s));
  }
  const Trajectory trajectory = read_tum_trajectory(path);
  if (!has_clock && has_frame_numbers(path))
    return expect_some(poses_by_number(sequence, trajectory), path, "poses of the sequence's frame numbers");
  return expect_some(poses_by_time(sequence, trajectory, max_gap_s), path, within(max_gap_s));
}

}  // namespace cairn
