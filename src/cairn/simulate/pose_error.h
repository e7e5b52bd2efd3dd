// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "cairn/geometry/rigid3.h"
#include "cairn/sequence/trajectory.h"

namespace cairn {

/// Describes the errors of given poses, as those of GNSS/INS: one that wanders, a first-order Gauss-Markov
/// process along and about each axis of the world, and one that is new in each pose. All are independent.
struct PoseErrorOptions {
  double position_std = 0;         ///< metres along each axis, of the error that wanders; 0 to 100
  double rotation_std_deg = 0;     ///< degrees about each axis, of the same; 0 to 10
  double correlation_time_s = 10;  ///< seconds after which its correlation has fallen to 1/e; 0.001 to 1e5
  double jitter_position_std = 0;  ///< metres along each axis, of the error that is new; 0 to 100
  double jitter_rotation_std_deg = 0;  ///< degrees about each axis, of the same; 0 to 10

  /// Throws InputError that names the option of the command line if a value is out of range.
  void validate() const;
  /// Returns whether any error is above 0.
  [[nodiscard]] bool is_any() const;
  /// Returns the standard deviation of both errors together along each axis, metres.
  [[nodiscard]] double total_position_std() const;
  /// Returns the standard deviation of both errors together about each axis, degrees.
  [[nodiscard]] double total_rotation_std_deg() const;
};

/// Holds poses with their stamps (nanoseconds): world_from_subject, of a camera or a body.
using StampedPoses = std::vector<std::pair<std::int64_t, Rigid3>>;

/// Returns the poses of a trajectory.
[[nodiscard]] StampedPoses stamped_poses(const Trajectory& trajectory);

/// Returns errors (c, w) at the stamps (nanoseconds, increasing): c of the position, metres, then w of the
/// rotation, radians, along and about the world's axes. The process is sampled exactly: over a gap dt its
/// correlation is exp(-dt / T), and its standard deviation is that of the options from the first stamp on.
/// The errors depend on the seed and the stamps alone; those of the first stamps are the same whatever
/// follows.
[[nodiscard]] std::vector<Vector6d> draw_pose_errors(const PoseErrorOptions& options,
                                                     std::span<const std::int64_t> stamps_ns,
                                                     std::uint64_t seed);

/// Returns the poses with errors that were drawn: centres t + c, rotations exp(w) R.
[[nodiscard]] StampedPoses with_pose_errors(const PoseErrorOptions& options, StampedPoses poses,
                                            std::uint64_t seed);

/// Formats poses as a table of quaternions (docs/poses.md) with the standard deviations of the options, its
/// columns between `separator`s: ',' for poses of a body, ' ' for those of a camera.
[[nodiscard]] std::string format_pose_table(const PoseErrorOptions& options, const StampedPoses& poses,
                                            char separator);

}  // namespace cairn
