// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cairn/geometry/rig.h"

namespace cairn {

struct RansacOptions {
  int max_iterations = 500;   ///< enough for 20 % inliers: 1 - (1 - 0.2^3)^500 = 98 %
  double confidence = 0.999;  ///< stop once a better sample is this unlikely
  std::uint64_t seed = 1;
};

struct PnpResult {
  bool found = false;  ///< false: fewer than 4 points, or no sample gave a pose
  Rigid3 camera_from_world;
  std::vector<std::int32_t> inliers;  ///< positions of observations within squared_error_limit, increasing
  int iterations = 0;
};

/// Camera pose from points and their observations: P3P in RANSAC (Fischler and Bolles 1981), samples scored
/// by the sum of bounded squared errors of (u, v, d) (MSAC, Torr and Zisserman 2000). Deterministic from the
/// seed.
[[nodiscard]] PnpResult solve_pnp_ransac(const Rig& rig, std::span<const Eigen::Vector3d> points_in_world,
                                         std::span<const Observation> seen, const RansacOptions& options);

}  // namespace cairn
