// SPDX-License-Identifier: Apache-2.0
#include "cairn/survey/frames.h"

#include <gtest/gtest.h>

#include "cairn/geometry/rigid3.h"

namespace cairn {
namespace {

GivenPose turned_pose() {
  const Eigen::Quaterniond rotation(0.3, -0.5, 0.7, 0.2);
  return {WorldFromCamera(Rigid3{rotation.normalized(), Eigen::Vector3d(5, -20, 1)}), {}};
}

TEST(StatedCovariance, is_that_of_the_perturbation_which_the_stated_error_is) {
  GivenPose given = turned_pose();
  const Eigen::Vector3d c(1e-5, 2e-5, -3e-5), w(-2e-5, 1e-5, 4e-5);  // an error, small
  given.uncertainty = PoseUncertainty{c * c.transpose(), w * w.transpose(), c * w.transpose()};
  const Rigid3& stated = given.world_from_camera;
  const Rigid3 is{rotation_exp(w) * stated.rotation, stated.translation + c};
  const Vector6d error = left_perturbation(stated.inverse(), is.inverse());
  EXPECT_LT((stated_covariance(given) - error * error.transpose()).norm(), 1e-4 * error.squaredNorm());
}

TEST(StatedCovariance, is_zero_where_nothing_is_stated) {
  EXPECT_TRUE(stated_covariance(turned_pose()).isZero(0));
}

}  // namespace
}  // namespace cairn
