// SPDX-License-Identifier: Apache-2.0
#include "cairn/testing/geometry/camera_paths.h"

#include <Eigen/Geometry>

namespace cairn::testkit {

Rigid3 aside(double x) {
  return {Eigen::Quaterniond::Identity(), {x, 0, 0}};
}

Rigid3 ahead(double z) {
  return {Eigen::Quaterniond::Identity(), {0, 0, z}};
}

WorldFromCamera on_bend(int frame) {
  return WorldFromCamera(
      Rigid3{rotation_exp(frame * Eigen::Vector3d(0.001, 0.004, -0.002)), {0.03 * frame, 0, 1.0 * frame}});
}

Rigid3 on_circle(int i, double turn, double step) {
  return {rotation_exp({0, -turn * i, 0}), {0, 0, -step / turn}};
}

double distance(const Rigid3& a, const Rigid3& b) {
  return (a.translation - b.translation).norm();
}

}  // namespace cairn::testkit
