// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "cairn/geometry/rigid3.h"

namespace cairn::testkit {

/// Holds two views of simulated points.
struct TwoViewScene {
  Rigid3 b_from_a;
  std::vector<Eigen::Vector3d> points_in_a;
  std::vector<Eigen::Vector2d> a, b;  ///< (x/z, y/z)
};

enum class SceneShape { volume, plane };

/// Returns a camera of about 60 degrees that turns by up to 0.3 rad and moves by `baseline`; points 2 to 6
/// away, with Gaussian noise of `sigma` in both views; the first `outliers` of them anywhere in b.
[[nodiscard]] TwoViewScene make_two_view_scene(std::uint64_t seed, int count, int outliers = 0,
                                               double sigma = 0, double baseline = 0.5,
                                               SceneShape shape = SceneShape::volume);

}  // namespace cairn::testkit
