// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "cairn/calibrate/quantity.h"
#include "cairn/core/executor.h"
#include "cairn/sequence/sequence.h"
#include "cairn/slam/slam.h"

namespace cairn {

/// Holds how depth images are shifted against the colour images that they belong to: columns and rows,
/// pixels, by which their content has to be moved (2), and seconds by which they were taken later than colour
/// (1).
struct DepthShift {
  Eigen::Vector3d value = Eigen::Vector3d::Zero();
  Eigen::Vector3d sigma = Eigen::Vector3d::Zero();
  std::array<Finding, 3> findings{};
  std::array<std::string, 3> why;  ///< why a term is undetermined
  int readings = 0;                ///< observations with a smooth depth around them
};

/// Measures the shift from the map of an RGB-D run: a landmark that is intersected from its pixels alone has
/// the inverse depth r in a keyframe, and the depth image the inverse depth m there, with the slopes g by
/// columns and rows of a plane through the depths around. Then
///
///     m - r = g . (du, dv) + (dr/dt - g . dp/dt) dt + a + b r,
///
/// with the motion dp/dt of the pixel; a and b stand for a depth camera's own errors. Robust least squares
/// (Cauchy's weights) over all observations; standard deviations with the readings of a keyframe taken as
/// one cluster, or half of what both halves of the keyframes differ by if that is more. A term is
/// undetermined if its standard deviation is above 0.5 px or 5 ms, and off if it is more than three of them
/// and than 1 px or 3 ms. Poses that were made with shifted depths take up a part of the shift, so that
/// less of it is found. Depth images that cannot be read are left out.
[[nodiscard]] DepthShift measure_depth_shift(const Sequence& sequence, const SlamResult& slam,
                                             const Executor& executor);

/// Moves the content of depth images by `shift_px`, pixels of the colour image, in a calibration with depth:
/// by the principal point of its depth camera, which is the colour camera if none was stated.
void move_depth(const Eigen::Vector2d& shift_px, Calibration& calibration);

/// Returns the terms as quantities.
[[nodiscard]] std::vector<Quantity> quantities_of(const DepthShift& found);

}  // namespace cairn
