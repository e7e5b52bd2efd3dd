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

}  // namespace
}  // namespace cairn
