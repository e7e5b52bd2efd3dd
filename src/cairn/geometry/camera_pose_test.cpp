// SPDX-License-Identifier: Apache-2.0
#include "cairn/geometry/camera_pose.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "cairn/core/error.h"
#include "cairn/core/random.h"
#include "cairn/core/text.h"
#include "cairn/geometry/pose_equations.h"
#include "cairn/testing/geometry/pose_scene.h"

namespace cairn {
namespace {

using testkit::error_of;
using testkit::kPoseRig;
using testkit::make_pose_scene;
using testkit::nudged;
using testkit::PoseScene;

/// All points, no kernel.
PoseOptions least_squares() {
  PoseOptions options;
  options.selection = PoseSelection::all;
  options.kernel = RobustKernel::none;
  return options;
}

PoseEstimate estimate(const PoseScene& scene, const PoseOptions& options) {
  return estimate_pose(kPoseRig, scene.correspondences(), nudged(scene.camera_from_world), options);
}

TEST(CameraPose, both_methods_reach_the_truth_without_noise) {
  for (const auto method : {PoseMethod::gauss_newton, PoseMethod::levenberg_marquardt}) {
    const PoseScene scene = make_pose_scene(1, {.count = 30, .noise = 0});
    PoseOptions options = least_squares();
    options.method = method;
    const PoseEstimate found = estimate(scene, options);
    ASSERT_TRUE(found.found());
    EXPECT_LT(error_of(found, scene).norm(), 1e-7);
    EXPECT_LT(found.cost, 1e-12);
    EXPECT_LE(found.iterations(), 8);
    for (std::size_t i = 1; i < found.trace.size(); ++i)
      EXPECT_LE(found.trace[i].cost, found.trace[i - 1].cost + 1e-12);
  }
}

/// 76 points of two images, from the identity: the known result of plain Gauss-Newton.
TEST(CameraPoseData, reaches_the_known_minimum_from_the_identity) {
  const std::filesystem::path folder = std::filesystem::path(CAIRN_DATA_DIR) / "course/pnp";
  if (!std::filesystem::exists(folder)) {
    ASSERT_EQ(std::getenv("CAIRN_REQUIRE_DATA"), nullptr) << folder << " is not there";
    GTEST_SKIP() << folder << " is not there";
  }
  const TextFile points(folder / "p3d.txt"), pixels(folder / "p2d.txt");
  std::vector<Eigen::Vector3d> in_world;
  std::vector<Observation> seen;
  for (const TextLine& line : points.lines())
    in_world.emplace_back(points.number(line, 0, "x"), points.number(line, 1, "y"),
                          points.number(line, 2, "z"));
  for (const TextLine& line : pixels.lines())
    seen.push_back({pixels.number(line, 0, "u"), pixels.number(line, 1, "v")});
  ASSERT_EQ(seen.size(), 76U);
  PoseOptions options = least_squares();
  options.method = PoseMethod::gauss_newton;
  const PoseEstimate found = estimate_pose({520.9, 521.0, 325.1, 249.7, 1.0}, {in_world, seen}, {}, options);
  ASSERT_TRUE(found.found());
  EXPECT_NEAR(found.cost, 150.6753269, 5e-8);
  EXPECT_GE(found.iterations(), 4);
  EXPECT_LE(found.iterations(), 5);
  Eigen::Matrix<double, 3, 4> known, pose;
  known << 0.997866, -0.051673, 0.039913, -0.127226, 0.050596, 0.998340, 0.027527, -0.007507, -0.041269,
      -0.025449, 0.998824, 0.061386;
  pose << found.camera_from_world.matrix3(), found.camera_from_world.translation;
  EXPECT_LT((pose - known).cwiseAbs().maxCoeff(), 1e-5);
}

TEST(CameraPose, kernels_withstand_outliers) {
  const PoseScene scene = make_pose_scene(2, {.count = 100, .noise = 0.5, .outliers = 15});
  const double plain = error_of(estimate(scene, least_squares()), scene).norm();
  for (const auto kernel : {RobustKernel::huber, RobustKernel::cauchy, RobustKernel::geman_mcclure}) {
    PoseOptions options = least_squares();
    options.kernel = kernel;
    if (kernel == RobustKernel::geman_mcclure) options.kernel_scale = 10;  // else 20 px of start are outliers
    const PoseEstimate found = estimate(scene, options);
    ASSERT_TRUE(found.found()) << static_cast<int>(kernel);
    EXPECT_LT(error_of(found, scene).norm(), 0.3 * plain) << static_cast<int>(kernel);
  }
}

TEST(CameraPose, takes_observations_back_that_the_start_missed_and_leaves_outliers_out) {
  PoseScene scene = make_pose_scene(2, {.count = 300, .stereo = true});
  Random random(3);
  for (std::size_t i = 0; i < 90; ++i) scene.seen[i].u += random.uniform(30, 200);
  const PoseEstimate found =
      estimate_pose(kPoseRig, scene.correspondences(), nudged(scene.camera_from_world, 0.1));
  ASSERT_TRUE(found.found());
  EXPECT_GT(found.inliers.size(), 190U);
  EXPECT_GE(found.inliers.front(), 90);
  EXPECT_LT(error_of(found, scene).norm(), 0.02);
}

TEST(CameraPose, begins_with_all_from_a_rough_start) {
  const PoseScene scene = make_pose_scene(4, {.count = 100, .stereo = true, .outliers = 10});
  const PoseEstimate found = estimate(scene, {.selection = PoseSelection::inliers_from_all});
  ASSERT_TRUE(found.found());
  EXPECT_GT(found.inliers.size(), 75U);
  EXPECT_FALSE(estimate(scene, {.selection = PoseSelection::inliers}).found());  // 20 px off: no inliers
}

TEST(CameraPose, levenberg_marquardt_comes_from_where_gauss_newton_fails) {
  int damped_alone = 0, plain_alone = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const PoseScene scene = make_pose_scene(seed, {.count = 30, .noise = 0});
    const auto solves = [&](PoseMethod method) {
      PoseOptions options = least_squares();
      options.method = method, options.max_iterations = 100;
      const PoseEstimate found =
          estimate_pose(kPoseRig, scene.correspondences(), nudged(scene.camera_from_world, 25), options);
      return found.found() && error_of(found, scene).norm() < 1e-5;
    };
    const bool plain = solves(PoseMethod::gauss_newton), damped = solves(PoseMethod::levenberg_marquardt);
    damped_alone += damped && !plain ? 1 : 0;
    plain_alone += plain && !damped ? 1 : 0;
  }
  EXPECT_GT(damped_alone, 5);
  EXPECT_EQ(plain_alone, 0);
}

TEST(CameraPose, says_why_there_is_no_pose) {
  PoseScene scene = make_pose_scene(3, {.count = 3});
  EXPECT_EQ(estimate(scene, least_squares()).status, PoseStatus::too_few_points);
  scene = make_pose_scene(4, {.count = 20});
  for (std::size_t i = 0; i < 20; ++i) {
    const Eigen::Vector3d in_camera(0.1 * static_cast<double>(i) - 1, 0.2, 3);
    const Eigen::Vector3d exact = kPoseRig.project(in_camera);
    scene.points[i] = scene.camera_from_world.inverse() * in_camera;
    scene.seen[i] = {exact.x(), exact.y()};
  }
  EXPECT_EQ(estimate(scene, least_squares()).status, PoseStatus::undetermined);
  scene = make_pose_scene(5, {.count = 20});
  const CameraFromWorld turned(Rigid3{rotation_exp({0, 3.1, 0}), {0, 0, 0}} * scene.camera_from_world);
  EXPECT_EQ(estimate_pose(kPoseRig, scene.correspondences(), turned, least_squares()).status,
            PoseStatus::behind_camera);
  PoseOptions hasty = least_squares();
  hasty.max_iterations = 1;
  EXPECT_EQ(estimate(scene, hasty).status, PoseStatus::not_converged);
  scene.points[2].z() = std::nan("");
  EXPECT_THROW((void)estimate(scene, least_squares()), PreconditionError);
}

TEST(CameraPose, refuses_lists_that_do_not_belong_together) {
  PoseScene scene = make_pose_scene(6, {.count = 20, .uncertain = true});
  scene.covariances.pop_back();
  EXPECT_THROW((void)estimate(scene, {}), PreconditionError);
  scene.covariances.clear();
  scene.points.pop_back();
  EXPECT_THROW((void)estimate(scene, {}), PreconditionError);
  EXPECT_THROW(PoseOptions{.rounds = 0}.validate(), PreconditionError);
}

TEST(CameraPose, poor_points_count_less) {
  double with = 0, without = 0;
  for (std::uint64_t run = 0; run < 50; ++run) {
    PoseScene scene = make_pose_scene(run, {.count = 60, .stereo = true});
    Random random(run, 1);
    for (std::size_t i = 0; i < 60; ++i) {
      const double sigma = i % 2 == 0 ? 0.005 : 0.15;
      scene.points[i] += sigma * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
      scene.covariances.emplace_back(sigma * sigma * Eigen::Matrix3d::Identity());
    }
    with += error_of(estimate(scene, {.selection = PoseSelection::all}), scene).tail<3>().norm();
    for (auto& covariance : scene.covariances) covariance = 0.15 * 0.15 * Eigen::Matrix3d::Identity();
    without += error_of(estimate(scene, {.selection = PoseSelection::all}), scene).tail<3>().norm();
  }
  EXPECT_LT(with, 0.9 * without);
}

TEST(Whiten, the_derivative_is_that_of_the_error) {
  const PoseScene scene = make_pose_scene(5, {.count = 5, .stereo = true, .uncertain = true});
  const Eigen::Matrix3d exact = Eigen::Matrix3d::Zero();  // a covariance moves with the pose
  for (std::size_t i = 0; i < 5; ++i) {
    const auto at = [&](const CameraFromWorld& pose, const Eigen::Matrix3d& covariance) {
      return whiten(kPoseRig, pose, scene.points[i], scene.seen[i], covariance);
    };
    const WhitenedError plain = at(scene.camera_from_world, exact);
    EXPECT_LT(at(scene.camera_from_world, scene.covariances[i]).error.norm(), plain.error.norm());
    const WhitenedError diagonal = whiten(kPoseRig, scene.camera_from_world * scene.points[i], scene.seen[i]);
    EXPECT_LT((diagonal.error - plain.error).norm() + (diagonal.jacobian - plain.jacobian).norm(), 1e-9);
    for (int axis = 0; axis < 6; ++axis) {
      constexpr double kStep = 1e-6;
      const Vector6d step = kStep * Vector6d::Unit(axis);
      const Eigen::Vector3d slope = (at(perturb_left(step, scene.camera_from_world), exact).error -
                                     at(perturb_left(-step, scene.camera_from_world), exact).error) /
                                    (2 * kStep);
      EXPECT_LT((slope - plain.jacobian.col(axis)).norm(), 1e-4 * (1 + slope.norm()));
    }
  }
}

/// Returns stereo observations, of which the first `wrong` have disparities of another surface.
PoseScene with_wrong_disparities(int wrong) {
  PoseScene scene = make_pose_scene(7, {.count = 200, .noise = 0.3, .stereo = true});
  for (int i = 0; i < wrong; ++i) {
    Observation& seen = scene.seen[static_cast<std::size_t>(i)];
    if (seen.has_disparity()) seen.d *= 1.5;
  }
  return scene;
}

TEST(CameraPose, a_wrong_disparity_does_not_throw_its_pixel_away) {
  const PoseScene scene = with_wrong_disparities(120);
  const PoseEstimate found =
      estimate_pose(kPoseRig, scene.correspondences(), nudged(scene.camera_from_world, 0.05));
  ASSERT_TRUE(found.found());
  EXPECT_GT(found.inliers.size(), 190U);
  EXPECT_GT(found.wrong_disparities.size(), 70U);  // of 80
  for (const std::int32_t i : found.wrong_disparities) EXPECT_LT(i, 120);
  const PoseEstimate strict = estimate_pose(kPoseRig, scene.correspondences(),
                                            nudged(scene.camera_from_world, 0.05), {.keep_pixels = false});
  EXPECT_LT(strict.inliers.size(), 130U);
  EXPECT_TRUE(strict.wrong_disparities.empty());
  EXPECT_LT(error_of(found, scene).norm(), 5e-3);
}

TEST(CameraPose, leaves_a_wrong_disparity_out_of_its_result) {
  const PoseScene scene = with_wrong_disparities(120);
  PoseScene without = scene;
  for (std::size_t i = 0; i < 120; ++i) testkit::forget_disparity(without.seen[i]);
  const auto start = nudged(scene.camera_from_world, 0.05);
  const PoseEstimate found = estimate_pose(kPoseRig, scene.correspondences(), start),
                     expected = estimate_pose(kPoseRig, without.correspondences(), start);
  EXPECT_LT(motion_norm(found.camera_from_world * expected.camera_from_world.inverse()), 1e-3);
}

TEST(CameraPose, judges_pixel_and_disparity_apart) {
  const Eigen::Vector3d point(0, 0, 2);
  const Eigen::Vector3d exact = kPoseRig.project(point);
  const auto judged = [&](double du, double dd) {
    return agreement(kPoseRig, point, {exact.x() + du, exact.y(), exact.z() + dd, 1, 0.1});
  };
  EXPECT_EQ(judged(0.5, 0.1), Agreement::full);
  EXPECT_EQ(judged(0.5, 5), Agreement::pixel);
  EXPECT_EQ(judged(5, 5), Agreement::none);
  EXPECT_EQ(judged(2.7, 0), Agreement::full);     // within the limit of three coordinates
  EXPECT_EQ(judged(2.4, 0.25), Agreement::none);  // neither is grossly wrong, together they are too far off
  EXPECT_EQ(agreement(kPoseRig, -point, {exact.x(), exact.y()}), Agreement::none);
}

}  // namespace
}  // namespace cairn
