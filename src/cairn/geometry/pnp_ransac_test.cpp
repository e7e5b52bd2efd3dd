// SPDX-License-Identifier: Apache-2.0
#include "cairn/geometry/pnp_ransac.h"

#include <gtest/gtest.h>

#include "cairn/core/error.h"
#include "cairn/core/random.h"

namespace cairn {
namespace {

constexpr Rig kRig{525, 525, 319.5, 239.5, 0.075};

struct Scene {
  CameraFromWorld camera_from_world;
  std::vector<Eigen::Vector3d> points;
  std::vector<Observation> seen;
};

/// Points in view at 1 to 5 m, seen with half a pixel of noise; the first `outliers` of them anywhere in the
/// image.
Scene make_scene(int count, int outliers, std::uint64_t seed) {
  Random random(seed);
  Scene scene;
  scene.camera_from_world =
      CameraFromWorld({rotation_exp({random.normal(), random.normal(), random.normal()}),
                       {random.normal(), random.normal(), random.normal()}});
  const Rigid3 world_from_camera = scene.camera_from_world.inverse();
  for (int i = 0; i < count; ++i) {
    const double depth = random.uniform(1, 5);
    const Eigen::Vector3d in_camera = kRig.point_at(random.uniform(0, 639), random.uniform(0, 479), depth);
    const Eigen::Vector3d exact = kRig.project(in_camera);
    Observation seen{exact.x() + 0.5 * random.normal(), exact.y() + 0.5 * random.normal(),
                     exact.z() + 0.1 * random.normal(), 0.5, 0.1};
    if (i < outliers)
      seen = {random.uniform(0, 639), random.uniform(0, 479), kRig.disparity(random.uniform(1, 5)), 0.5, 0.1};
    scene.points.push_back(world_from_camera * in_camera);
    scene.seen.push_back(seen);
  }
  return scene;
}

TEST(PnpRansac, finds_the_pose_among_outliers) {
  for (const int outliers : {0, 50, 100, 140}) {
    const Scene scene = make_scene(200, outliers, 30 + static_cast<std::uint64_t>(outliers));
    const PnpResult result = solve_pnp_ransac(kRig, scene.points, scene.seen, {});
    ASSERT_TRUE(result.found()) << outliers;
    EXPECT_LT(motion_norm(result.camera_from_world * scene.camera_from_world.inverse()), 0.05) << outliers;
    int wrong = 0;
    for (const std::int32_t i : result.inliers) wrong += i < outliers ? 1 : 0;
    EXPECT_LE(wrong, 2) << outliers;
    EXPECT_GT(static_cast<int>(result.inliers.size()), (200 - outliers) / 2) << outliers;
  }
}

TEST(PnpRansac, stops_early_where_all_agree) {
  const Scene scene = make_scene(200, 0, 40);
  EXPECT_LT(solve_pnp_ransac(kRig, scene.points, scene.seen, {}).iterations, 50);
}

TEST(PnpRansac, says_so_where_nothing_fits) {
  for (const int count : {4, 5, 8, 20, 200}) {
    const Scene scene = make_scene(count, count, 41);
    const PnpResult result = solve_pnp_ransac(kRig, scene.points, scene.seen, {});
    EXPECT_FALSE(result.found()) << count;
    EXPECT_LT(result.inliers.size(), 12U);
  }
}

TEST(PnpRansac, says_so_where_all_points_lie_on_a_line) {
  Scene scene = make_scene(20, 0, 45);
  for (std::size_t i = 0; i < scene.points.size(); ++i) {
    const Eigen::Vector3d in_camera(0.05 * static_cast<double>(i) - 0.5, 0.1, 2);
    const Eigen::Vector3d exact = kRig.project(in_camera);
    scene.points[i] = scene.camera_from_world.inverse() * in_camera;
    scene.seen[i] = {exact.x(), exact.y()};
  }
  EXPECT_EQ(solve_pnp_ransac(kRig, scene.points, scene.seen, {}).status, RansacStatus::degenerate);
}

TEST(PnpRansac, refuses_numbers_that_are_not_finite) {
  Scene scene = make_scene(20, 0, 46);
  scene.seen[3].u = std::nan("");
  EXPECT_THROW((void)solve_pnp_ransac(kRig, scene.points, scene.seen, {}), PreconditionError);
}

TEST(PnpRansac, does_not_begin_with_fewer_than_four_points) {
  for (const int count : {0, 1, 3}) {
    const Scene scene = make_scene(count, 0, 42);
    EXPECT_FALSE(solve_pnp_ransac(kRig, scene.points, scene.seen, {}).found());
  }
}

TEST(PnpRansac, finds_nothing_where_all_points_are_one) {
  Scene scene = make_scene(20, 0, 43);
  for (auto& point : scene.points) point = scene.points[0];
  for (auto& seen : scene.seen) seen = scene.seen[0];
  EXPECT_FALSE(solve_pnp_ransac(kRig, scene.points, scene.seen, {}).found());
}

TEST(JudgePose, says_of_its_own_pose_what_ransac_says) {
  const Scene scene = make_scene(200, 100, 47);
  const PnpResult found = solve_pnp_ransac(kRig, scene.points, scene.seen, {});
  const RansacReport judged = judge_pose(kRig, scene.points, scene.seen, found.camera_from_world);
  EXPECT_EQ(judged.status, RansacStatus::ok);
  EXPECT_EQ(judged.inliers, found.inliers);
  EXPECT_NEAR(judged.cost, found.cost, 1e-9);
  EXPECT_EQ(judged.log10_false_alarms, found.log10_false_alarms);
}

TEST(JudgePose, does_not_believe_a_wrong_pose_nor_too_few_points) {
  const Scene scene = make_scene(200, 0, 48), few = make_scene(2, 0, 49);
  Vector6d xi;
  xi << 0.2, -0.1, 0.3, 0.1, 0.2, 0.3;
  const CameraFromWorld wrong = perturb_left(xi, scene.camera_from_world);
  EXPECT_EQ(judge_pose(kRig, scene.points, scene.seen, wrong).status, RansacStatus::by_chance);
  EXPECT_EQ(judge_pose(kRig, few.points, few.seen, few.camera_from_world).status, RansacStatus::too_few_data);
}

TEST(PnpRansac, repeats_itself_from_the_seed) {
  const Scene scene = make_scene(100, 60, 44);
  const PnpResult a = solve_pnp_ransac(kRig, scene.points, scene.seen, {.seed = 7});
  const PnpResult b = solve_pnp_ransac(kRig, scene.points, scene.seen, {.seed = 7});
  EXPECT_EQ(a.inliers, b.inliers);
  EXPECT_EQ(a.camera_from_world.rotation.coeffs(), b.camera_from_world.rotation.coeffs());
  EXPECT_EQ(a.camera_from_world.translation, b.camera_from_world.translation);
}

TEST(PnpRansac, finds_the_pose_although_most_disparities_are_wrong) {
  Scene scene = make_scene(200, 40, 45);
  for (std::size_t i = 0; i < 160; ++i) scene.seen[i].d *= 0.7;
  const PnpResult result = solve_pnp_ransac(kRig, scene.points, scene.seen, {});
  ASSERT_TRUE(result.found());
  EXPECT_LT(motion_norm(result.camera_from_world * scene.camera_from_world.inverse()), 0.02);
  EXPECT_GT(result.inliers.size(), 135U);  // of 160: 0.95 of pixels are within their limit
}

TEST(PnpRansac, an_observation_costs_more_the_more_its_disparity_is_wrong) {
  const Scene scene = make_scene(1, 0, 3);
  const Observation& exact = scene.seen[0];
  double last = -1;
  for (const double wrong_px : {0.0, 0.1, 0.14, 0.2, 0.24, 0.26, 1.0, 20.0}) {
    std::vector<Observation> seen{exact, exact, exact};
    for (Observation& one : seen) one.d += wrong_px;
    const Eigen::Vector3d& point = scene.points[0];
    const double cost =
        judge_pose(kRig, std::vector{point, point, point}, seen, scene.camera_from_world).cost;
    EXPECT_GE(cost, last - 1e-9) << wrong_px;
    last = cost;
  }
}

}  // namespace
}  // namespace cairn
