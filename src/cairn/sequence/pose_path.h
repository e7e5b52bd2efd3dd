// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cairn/geometry/rigid3.h"
#include "cairn/sequence/given_poses.h"

namespace cairn {

/// Holds the pose of a subject, a camera or a body, at a time.
struct SubjectPose {
  std::int64_t stamp_ns = 0;
  Rigid3 world_from_subject;
};

/// Interpolates poses over time.
class PosePath {
 public:
  PosePath() = default;
  /// Takes poses whose stamps increase strictly. Those further apart than `max_gap_s` (seconds, 0 or more)
  /// are not interpolated between.
  PosePath(std::vector<SubjectPose> poses, double max_gap_s);

  /// Computes world_from_subject at `stamp_ns` if `offset_s`, seconds, is added to the stamps of the poses.
  /// Through the two poses before and the two after goes a cubic, of the positions and of the rotation
  /// vectors relative to the pose before; where there are only one before and one after near enough, a line.
  /// Returns nullopt where there are not even these, unless a pose is within a millisecond.
  [[nodiscard]] std::optional<Rigid3> at(std::int64_t stamp_ns, double offset_s = 0) const;

  [[nodiscard]] const std::vector<SubjectPose>& poses() const { return poses_; }

 private:
  [[nodiscard]] bool is_near(std::size_t before) const;
  [[nodiscard]] Rigid3 between(std::size_t before, double seconds) const;

  std::vector<SubjectPose> poses_;
  double max_gap_s_ = 0;
};

/// Holds given poses over time, before they are those of frames.
struct GivenPath {
  PosePath path;               ///< in the world of read_given_poses
  Rigid3 subject_from_camera;  ///< stated pose, on the subject, of the camera whose images FrameLoader gives
  /// Whether the calibration states that pose; else the poses are the camera's own and it is the identity.
  bool is_of_body = false;
  /// Whether the poses belong to frames by their number or order, so that no offset can be given; the stamps
  /// are those of the frames.
  bool is_by_frame = false;
  double time_offset_s = 0;  ///< was added to the poses' stamps
  std::filesystem::path source;
  std::string format;                 ///< as GivenPoses::format
  std::vector<std::string> warnings;  ///< what a person should know, a sentence each
};

/// Reads the poses that read_given_poses reads, under the same rules, with their own stamps. Throws
/// InputError as that does.
[[nodiscard]] GivenPath read_given_path(const Sequence& sequence, const GivenPosesOptions& options = {});

}  // namespace cairn
