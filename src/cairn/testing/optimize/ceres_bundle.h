// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "cairn/optimize/bundle_adjustment.h"

namespace cairn::testkit {

/// Solves a problem of bundle adjustment with Ceres, with the same perturbation and analytic Jacobians.
class CeresBundle {
 public:
  enum class Schur { dense, sparse };
  /// Holds half the sums of the squared errors, after the robust kernel.
  struct Costs {
    double initial = 0, final = 0;
  };

  /// Copies the start; `problem` must live until the last call of `solve`.
  explicit CeresBundle(const BundleProblem& problem);

  /// Adjusts cameras and points, in one thread.
  Costs solve(const BundleOptions& options, Schur type);

  [[nodiscard]] Rigid3 camera_from_world(std::size_t camera) const;

 private:
  using Pose = std::array<double, 7>;  ///< qx qy qz qw x y z

  const BundleProblem* problem_;
  std::vector<Pose> cameras_;
  std::vector<Eigen::Vector3d> points_;
};

}  // namespace cairn::testkit
