// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>

#include "cairn/geometry/rigid3.h"

namespace cairn {

/// Describes a similarity target_from_source: point_in_target = scale * rotation * point_in_source +
/// translation.
struct Similarity3 {
  double scale = 1;
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
};

/// Maps a point from the source to the target.
[[nodiscard]] inline Eigen::Vector3d operator*(const Similarity3& target_from_source,
                                               const Eigen::Vector3d& point) {
  return target_from_source.scale * (target_from_source.rotation * point) + target_from_source.translation;
}

/// Maps the pose of a camera to the target: its position is scaled, its axes stay unit vectors.
[[nodiscard]] inline Rigid3 operator*(const Similarity3& target_from_world, const Rigid3& world_from_camera) {
  return {(target_from_world.rotation * world_from_camera.rotation).normalized(),
          target_from_world * world_from_camera.translation};
}

/// Says if an alignment is unique and, if not, why.
enum class AlignmentStatus {
  ok,
  too_few_points,  ///< fewer than 3
  one_place,       ///< all points of a set coincide
  one_line,        ///< all points of a set lie on one line, so the turn about it is free
  mirrored,        ///< the sets are mirror images such that several rotations fit equally well
};

/// Holds the result of align_points.
struct Alignment {
  AlignmentStatus status = AlignmentStatus::too_few_points;
  Similarity3 target_from_source;  ///< the identity unless status is ok
  double rmse = 0;                 ///< root mean square of the residuals, in the target's unit
  /// Uncertainty of the rotation about the main line of the points, radians, at most pi: the root mean square
  /// residual across that line over the spread of the points across it. If the points lie nearly on a line,
  /// only this spread determines that rotation. Assumes that residuals do not average out, as those of drift
  /// do not.
  double turn_uncertainty = 0;
};

/// Computes sqrt(mean || target_i - target_from_source source_i ||^2); returns 0 for no points. Throws
/// PreconditionError if the spans differ in length.
[[nodiscard]] double rms_distance(const Similarity3& target_from_source,
                                  std::span<const Eigen::Vector3d> source,
                                  std::span<const Eigen::Vector3d> target);

/// Computes the similarity (the rigid transform if `with_scale` is false) with the least squared distances
///
///     sum_i || target_i - (s R source_i + t) ||^2,
///
/// in closed form (Umeyama 1991, eq. 34 to 42): with U D V^T the singular value decomposition of the
/// covariance of target and source, R = U S V^T, s = tr(D S) / var(source), t = mean(target) - s R
/// mean(source), and S = diag(1, 1, det U det V), which excludes reflections. It is unique if d_2 + S_33 d_3
/// > 0, with d_i the singular values in decreasing order; otherwise the status says why not. Points
/// correspond by position. Throws PreconditionError if the spans differ in length or a coordinate is not a
/// number below 1e100.
[[nodiscard]] Alignment align_points(std::span<const Eigen::Vector3d> source,
                                     std::span<const Eigen::Vector3d> target, bool with_scale);

}  // namespace cairn
