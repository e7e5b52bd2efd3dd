// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cmath>

namespace cairn {

/// The quaternion over its length; as it is where that is 1 up to rounding, so that a rotation which was
/// written out with all digits comes back bit by bit. Its length is not 0.
[[nodiscard]] inline Eigen::Quaterniond unit_rotation(const Eigen::Quaterniond& rotation) {
  constexpr double kRounding = 1e-15;  // what normalized() leaves
  return std::abs(rotation.norm() - 1.0) <= kRounding ? rotation : rotation.normalized();
}

}  // namespace cairn
