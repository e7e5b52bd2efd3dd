// SPDX-License-Identifier: Apache-2.0
#include "cairn/localize/precision.h"

#include <gtest/gtest.h>

#include <cmath>

#include "cairn/testing/geometry/pose_scene.h"

namespace cairn {
namespace {

using testkit::kPoseRig;
using testkit::make_pose_scene;
using testkit::PoseScene;

/// The first `count` correspondences of a scene whose points are uncertain.
Correspondences first(const PoseScene& scene, std::size_t count) {
  return {std::span(scene.points).first(count), std::span(scene.seen).first(count),
          std::span(scene.covariances).first(count)};
}

TEST(Precision, dilution_follows_the_geometry) {
  const PoseScene scene = make_pose_scene(7, {.count = 100, .stereo = true, .uncertain = true});
  const auto precision = [&](std::size_t count) {
    const Correspondences given = first(scene, count);
    return assess_precision(kPoseRig, given, estimate_pose(kPoseRig, given, scene.camera_from_world));
  };
  const Precision all = precision(100), fewer = precision(50);
  EXPECT_NEAR(fewer.gdop / all.gdop, std::sqrt(2.0), 0.25);  // twice the observations
  EXPECT_NEAR(all.gdop, all.dilution.tail<3>().norm(), 1e-12);
  for (int axis = 0; axis < 6; ++axis) EXPECT_LT(all.protection[axis], fewer.protection[axis] * 1.05);
}

/// Observations are twice as good as they state: residuals say so, but an error of one observation goes
/// unnoticed as long as the stated deviations explain it.
TEST(Precision, follows_residuals_that_are_smaller_than_stated_if_it_may) {
  PoseScene scene = make_pose_scene(7, {.count = 200, .stereo = true, .uncertain = true});
  for (Observation& seen : scene.seen) {
    seen.sigma_px *= 2;
    seen.sigma_d_px *= 2;
  }
  for (Eigen::Matrix3d& covariance : scene.covariances) covariance *= 4;
  const Correspondences given = first(scene, 200);
  const PoseEstimate pose = estimate_pose(kPoseRig, given, scene.camera_from_world);
  EXPECT_NEAR(pose.variance_factor, 0.25, 0.25 * 5 * std::sqrt(2.0 / 594));  // 5 deviations of its own
  const Precision stated = assess_precision(kPoseRig, given, pose),
                  seen = assess_precision(kPoseRig, given, pose, NoiseScale::as_residuals);
  EXPECT_EQ(stated.covariance, pose.covariance);
  EXPECT_LT((seen.covariance - pose.variance_factor * pose.covariance).norm(),
            1e-12 * pose.covariance.norm());
  const double two_sided = 3.291;  // deviations for 1e-3
  const auto unnoticed = [&](const Precision& precision) -> Vector6d {
    return precision.protection - two_sided * precision.covariance.diagonal().cwiseSqrt();
  };
  EXPECT_LT((unnoticed(stated) - unnoticed(seen)).norm(), 1e-12);
}

}  // namespace
}  // namespace cairn
