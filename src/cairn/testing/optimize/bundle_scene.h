// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "cairn/optimize/bundle_adjustment.h"

namespace cairn::testkit {

/// Describes a BundleScene.
struct BundleSceneOptions {
  int cameras = 8;
  int fixed = 2;  ///< the first ones
  int points = 100;
  int longest_track = 6;       ///< cameras in a row that may see a point; each from 2 to this many
  double disparity_share = 1;  ///< of the observations
  double outlier_share = 0;    ///< of the observations
  double outlier_px = 20;      ///< their rows are one to three times this aside
  double sigma_px = 0.7;       ///< of u, v and d, as stated to the solver
  double noise = 1;            ///< standard deviations of the pixels
  double start_error = 1;      ///< times 0.01 rad and 3 cm of the free cameras, 5 cm of the points
};

/// Holds a problem of bundle adjustment with the truth.
struct BundleScene {
  BundleProblem problem;
  std::vector<Rigid3> true_cameras;
  std::vector<Eigen::Vector3d> true_points;
};

/// Returns cameras a tenth of a metre apart on an arc, or a circle if there are enough of them, that look
/// outwards at points 1.5 to 8 m away.
[[nodiscard]] BundleScene make_bundle_scene(std::uint64_t seed, const BundleSceneOptions& options = {});

}  // namespace cairn::testkit
