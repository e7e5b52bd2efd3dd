// SPDX-License-Identifier: Apache-2.0
#include "cairn/testing/geometry/reference_drive.h"

#include <Eigen/Geometry>
#include <cmath>

namespace cairn::testkit {

Rigid3 true_drive(int i) {
  return {rotation_exp({0.01 * std::sin(0.7 * i), 0.02 * std::cos(0.3 * i), 0.8 * std::sin(0.02 * i) + 0.1}),
          {3 * i + 20 * std::sin(0.05 * i), 40 * std::sin(0.03 * i), std::sin(0.01 * i)}};
}

Rigid3 estimated_drive(int i) {
  const Rigid3 truth = true_drive(i);
  const Eigen::Quaterniond away = rotation_exp({0.00001 * i, 0.00002 * i, 0.0001 * i + 0.001});
  const Eigen::Quaterniond wobble =
      rotation_exp({0.001 * std::sin(i), 0.002 * std::cos(2 * i), 0.001 * std::sin(3 * i)});
  const Eigen::Vector3d noise(std::sin(2 * i), std::sin(3 * i), std::sin(4 * i));
  return {away * truth.rotation * wobble, 1.01 * (away * truth.translation) + 0.05 * noise};
}

}  // namespace cairn::testkit
