// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>

#include "cairn/geometry/rigid3.h"

namespace cairn {

/// A similarity target_from_source: point_in_target = scale * rotation * point_in_source + translation.
struct Similarity3 {
  double scale = 1;
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
};

[[nodiscard]] inline Eigen::Vector3d operator*(const Similarity3& target_from_source,
                                               const Eigen::Vector3d& point) {
  return target_from_source.scale * (target_from_source.rotation * point) + target_from_source.translation;
}

/// The pose of a camera after its world is mapped: its place is scaled, its axes stay unit.
[[nodiscard]] inline Rigid3 operator*(const Similarity3& target_from_world, const Rigid3& world_from_camera) {
  return {(target_from_world.rotation * world_from_camera.rotation).normalized(),
          target_from_world * world_from_camera.translation};
}

enum class AlignmentStatus {
  ok,
  too_few_points,  ///< fewer than 3
  one_place,       ///< all points of a set are the same
  one_line,        ///< all points of a set lie on one line, so the turn about it is free
  mirrored,        ///< the sets are mirror images in such a way that several rotations fit equally well
};

struct Alignment {
  AlignmentStatus status = AlignmentStatus::too_few_points;
  Similarity3 target_from_source;  ///< the identity unless status is ok
  double rmse = 0;                 ///< root mean square of what remains, in the target's unit
  /// How far the residuals can turn the result about the points' main line, radians up to pi: root mean
  /// square of what remains across that line by how far the points spread across it. Where points lie nearly
  /// on a line, only this spread fixes that turn. As if residuals did not average out, as those of drift do
  /// not.
  double turn_uncertainty = 0;
};

/// sqrt(mean || target_i - target_from_source source_i ||^2), 0 for no points.
[[nodiscard]] double rms_distance(const Similarity3& target_from_source,
                                  std::span<const Eigen::Vector3d> source,
                                  std::span<const Eigen::Vector3d> target);

/// The similarity (or with `with_scale` false the rigid transform) with the least squared distances
///
///     sum_i || target_i - (s R source_i + t) ||^2,
///
/// in closed form (Umeyama 1991, eq. 34 to 42): with U D V^T the singular values of the covariance of target
/// and source, R = U S V^T, s = tr(D S) / var(source), t = mean(target) - s R mean(source), where S =
/// diag(1, 1, det U det V) excludes reflections. It is unique where d_2 + S_33 d_3 > 0, d_i the singular
/// values in falling order; else the status says why not. Points correspond by position; both spans have one
/// length. PreconditionError for a coordinate that is not a number below 1e100.
[[nodiscard]] Alignment align_points(std::span<const Eigen::Vector3d> source,
                                     std::span<const Eigen::Vector3d> target, bool with_scale);

}  // namespace cairn
