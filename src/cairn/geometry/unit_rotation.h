// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cmath>

namespace cairn {

/// Returns the quaternion divided by its length, which must not be 0. Returns it unchanged if the length is 1
/// up to rounding, so that a rotation written with all digits is read back bit by bit.
[[nodiscard]] inline Eigen::Quaterniond unit_rotation(const Eigen::Quaterniond& rotation) {
  constexpr double kRounding = 1e-15;  // what normalized() leaves
  return std::abs(rotation.norm() - 1.0) <= kRounding ? rotation : rotation.normalized();
}

}  // namespace cairn
