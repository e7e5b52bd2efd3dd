// SPDX-License-Identifier: Apache-2.0
#include "cairn/optimize/pose_only.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "cairn/core/random.h"

namespace cairn {
namespace {

constexpr Rig kRig{525, 525, 319.5, 239.5, 0.075};

struct Scene {
  CameraFromWorld camera_from_world;
  std::vector<Eigen::Vector3d> points;
  std::vector<Observation> seen;
};

/// Points in view at 1 to 5 m with Gaussian noise as the observations' sigmas say; each third one has no
/// disparity.
Scene make_scene(int count, std::uint64_t seed) {
  Random random(seed);
  Scene scene;
  scene.camera_from_world =
      CameraFromWorld({rotation_exp({random.normal(), random.normal(), random.normal()}),
                       {random.normal(), random.normal(), random.normal()}});
  const Rigid3 world_from_camera = scene.camera_from_world.inverse();
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d in_camera =
        kRig.point_at(random.uniform(0, 639), random.uniform(0, 479), random.uniform(1, 5));
    const Eigen::Vector3d exact = kRig.project(in_camera);
    Observation seen;
    seen.sigma_px = random.uniform(0.5, 2.0);
    seen.sigma_d_px = 0.1;
    seen.u = exact.x() + seen.sigma_px * random.normal();
    seen.v = exact.y() + seen.sigma_px * random.normal();
    if (i % 3 != 0) seen.d = exact.z() + seen.sigma_d_px * random.normal();
    scene.points.push_back(world_from_camera * in_camera);
    scene.seen.push_back(seen);
  }
  return scene;
}

CameraFromWorld nudge(const CameraFromWorld& pose) {
  Vector6d xi;
  xi << 0.02, -0.03, 0.01, 0.03, 0.02, -0.02;
  return perturb_left(xi, pose);
}

/// The left perturbation that takes the truth to the estimate, to first order.
Vector6d error_of(const Rigid3& estimate, const Rigid3& truth) {
  const Rigid3 difference = estimate * truth.inverse();
  Vector6d xi;
  xi << rotation_log(difference.rotation), difference.translation;
  return xi;
}

TEST(PoseOnly, reaches_the_truth_without_noise) {
  Scene scene = make_scene(50, 1);
  for (std::size_t i = 0; i < scene.points.size(); ++i) {
    const Eigen::Vector3d exact = kRig.project(scene.camera_from_world * scene.points[i]);
    scene.seen[i].u = exact.x();
    scene.seen[i].v = exact.y();
    if (scene.seen[i].has_disparity()) scene.seen[i].d = exact.z();
    scene.seen[i].sigma_px = 20;  // wide enough that the start counts all as inliers
    scene.seen[i].sigma_d_px = 5;
  }
  const PoseOnlyResult result = refine_pose(kRig, scene.points, scene.seen, nudge(scene.camera_from_world));
  ASSERT_TRUE(result.solved);
  EXPECT_EQ(result.inliers.size(), 50U);
  EXPECT_LT(error_of(result.camera_from_world, scene.camera_from_world).norm(), 1e-8);
}

TEST(PoseOnly, takes_observations_back_that_the_start_missed_and_leaves_outliers_out) {
  Scene scene = make_scene(300, 2);
  Random random(3);
  for (std::size_t i = 0; i < 90; ++i) scene.seen[i].u += random.uniform(30, 200);
  Vector6d slight;
  slight << 0.002, -0.001, 0.002, 0.005, 0.005, -0.005;
  const PoseOnlyResult result =
      refine_pose(kRig, scene.points, scene.seen, perturb_left(slight, scene.camera_from_world));
  ASSERT_TRUE(result.solved);
  EXPECT_GT(result.inliers.size(), 190U);
  EXPECT_GE(result.inliers.front(), 90);
  EXPECT_LT(error_of(result.camera_from_world, scene.camera_from_world).norm(), 0.01);
}

/// Normalised estimation error squared over many problems: 6 on average where the information is honest.
TEST(PoseOnly, reports_an_honest_information) {
  double sum = 0;
  constexpr int kProblems = 200;
  for (int i = 0; i < kProblems; ++i) {
    const Scene scene = make_scene(150, 100 + static_cast<std::uint64_t>(i));
    const PoseOnlyResult result = refine_pose(kRig, scene.points, scene.seen, scene.camera_from_world);
    ASSERT_TRUE(result.solved);
    const Vector6d error = error_of(result.camera_from_world, scene.camera_from_world);
    sum += error.dot(result.information * error);
  }
  const double per_degree_of_freedom = sum / (6 * kProblems);
  EXPECT_GT(per_degree_of_freedom, 0.85);
  EXPECT_LT(per_degree_of_freedom,
            1.25);  // leaving out the worst 5 % of good observations makes it slightly too sure
}

TEST(PoseOnly, says_so_where_there_is_too_little) {
  Scene few = make_scene(3, 4);
  EXPECT_FALSE(refine_pose(kRig, few.points, few.seen, few.camera_from_world).solved);
  Scene one_place = make_scene(20, 5);
  for (auto& point : one_place.points) point = one_place.points[1];
  for (auto& seen : one_place.seen) seen = one_place.seen[1];
  EXPECT_FALSE(refine_pose(kRig, one_place.points, one_place.seen, one_place.camera_from_world).solved);
}

}  // namespace
}  // namespace cairn
