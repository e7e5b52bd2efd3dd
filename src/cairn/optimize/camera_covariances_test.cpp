// SPDX-License-Identifier: Apache-2.0
#include "cairn/optimize/camera_covariances.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "cairn/core/error.h"
#include "cairn/core/random.h"
#include "cairn/testing/geometry/random_points.h"
#include "cairn/testing/optimize/bundle_scene.h"

namespace cairn {
namespace {

using testkit::BundleScene;
using testkit::make_bundle_scene;

std::vector<char> all_of(const BundleProblem& problem) {
  return std::vector<char>(problem.observations.size(), 1);
}

Rigid3 motion_of(const std::vector<Rigid3>& cameras, const CameraMotion& motion) {
  return cameras[static_cast<std::size_t>(motion.to)] *
         cameras[static_cast<std::size_t>(motion.from)].inverse();
}

double nees_of(const BundleScene& scene, const CameraMotion& motion, const Matrix6d& covariance) {
  const Vector6d error = left_perturbation(motion_of(scene.problem.camera_from_world, motion),
                                           motion_of(scene.true_cameras, motion));
  return error.dot(covariance.llt().solve(error)) / 6;
}

/// All unknowns of a problem, of which camera 0 is fixed, in one dense matrix.
Eigen::MatrixXd dense_covariance(const BundleProblem& problem) {
  const auto cameras = 6 * (static_cast<Eigen::Index>(problem.camera_from_world.size()) - 1);
  const auto size = cameras + 3 * static_cast<Eigen::Index>(problem.points_in_world.size());
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(size, size);
  for (const auto& [camera, point, seen] : problem.observations) {
    const Rigid3& pose = problem.camera_from_world[static_cast<std::size_t>(camera)];
    const Eigen::Vector3d in_camera = pose * problem.points_in_world[static_cast<std::size_t>(point)];
    const Eigen::Matrix3d by_point = problem.rig.projection_jacobian(in_camera);
    Eigen::MatrixXd row = Eigen::MatrixXd::Zero(3, size);
    if (camera > 0) row.middleCols<3>(6 * (camera - 1)) = -by_point * skew(in_camera);
    if (camera > 0) row.middleCols<3>(6 * (camera - 1) + 3) = by_point;
    row.middleCols<3>(cameras + 3 * point) = by_point * pose.matrix3();
    information += row.transpose() * inverse_variances(seen).asDiagonal() * row;
  }
  return information.inverse();
}

/// The derivative of a motion by the perturbations of all cameras but the first, by differences.
Eigen::MatrixXd derivative_of(const BundleProblem& problem, const CameraMotion& motion) {
  constexpr double kStep = 1e-6;
  const Rigid3 at = motion_of(problem.camera_from_world, motion);
  Eigen::MatrixXd derivative(6, 6 * (static_cast<Eigen::Index>(problem.camera_from_world.size()) - 1));
  for (Eigen::Index i = 0; i < derivative.cols(); ++i) {
    std::vector<Rigid3> moved = problem.camera_from_world;
    Rigid3& camera = moved[static_cast<std::size_t>(i / 6 + 1)];
    camera = perturb_left(kStep * Vector6d::Unit(i % 6), camera);
    derivative.col(i) = left_perturbation(at, motion_of(moved, motion)) / kStep;
  }
  return derivative;
}

TEST(CameraCovariances, the_formal_ones_are_those_of_the_dense_inverse) {
  const BundleScene scene =
      make_bundle_scene(3, {.cameras = 6, .fixed = 1, .points = 50, .noise = 0, .start_error = 0});
  const std::vector<CameraMotion> motions{{0, 1}, {0, 5}, {1, 2}, {4, 3}, {1, 5}};
  const CameraCovariances found =
      camera_covariances(scene.problem, all_of(scene.problem), motions, SharedField::none);
  ASSERT_TRUE(found.determined);
  const Eigen::MatrixXd all = dense_covariance(scene.problem);
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const Eigen::MatrixXd derivative = derivative_of(scene.problem, motions[i]);
    const Matrix6d expected =
        derivative * all.topLeftCorner(derivative.cols(), derivative.cols()) * derivative.transpose();
    EXPECT_LT((found.formal[i] - expected).norm(), 1e-4 * expected.norm()) << i;
  }
}

TEST(CameraCovariances, the_formal_ones_are_honest_for_independent_errors) {
  constexpr int kSeeds = 200;
  const std::vector<CameraMotion> motions{{0, 2}, {0, 5}, {2, 3}, {4, 5}};
  double nees = 0;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    BundleScene scene = make_bundle_scene(seed, {.cameras = 6, .fixed = 1, .points = 80, .start_error = 0.1});
    (void)adjust_bundle(scene.problem, {.max_iterations = 20, .converged_relative_cost = 1e-7});
    const CameraCovariances found =
        camera_covariances(scene.problem, all_of(scene.problem), motions, SharedField::none);
    ASSERT_TRUE(found.determined);
    for (std::size_t i = 0; i < motions.size(); ++i)
      nees += nees_of(scene, motions[i], found.formal[i]) / (kSeeds * static_cast<double>(motions.size()));
  }
  EXPECT_NEAR(nees, 1, 0.05);
}

/// Errors that observations have in common, which no stated standard deviation knows: the centre of each
/// point wanders with the view, by `wander` px from one camera to the next, and all disparities of a place in
/// the image are off by up to `bend` px.
void add_common_errors(std::uint64_t seed, double wander, double bend, BundleProblem& problem) {
  Random random(seed, 1);
  std::vector<Eigen::Vector2d> directions;
  for (std::size_t p = 0; p < problem.points_in_world.size(); ++p)
    directions.emplace_back(wander * random.normal(), wander * random.normal());
  const double phase = random.uniform(0, 6.3);
  for (BundleObservation& observation : problem.observations) {
    const Eigen::Vector2d& direction = directions[static_cast<std::size_t>(observation.point)];
    observation.seen.u += observation.camera * direction.x();
    observation.seen.v += observation.camera * direction.y();
    observation.seen.d +=
        bend * std::sin(observation.seen.u / 40 + phase) * std::cos(observation.seen.v / 40);
  }
}

struct Honesty {
  double formal = 0, found = 0, covered = 0;  // mean NEES, and share inside the 95 % region
};

Honesty assess(double noise, double wander, double bend) {
  constexpr int kSeeds = 60;
  constexpr double kLimit95 = 12.592 / 6;  // chi-square with 6 degrees of freedom
  const std::vector<CameraMotion> motions{{0, 1}, {0, 5}, {2, 3}, {4, 5}};
  const double share = 1.0 / (kSeeds * static_cast<double>(motions.size()));
  Honesty honesty;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    BundleScene scene = make_bundle_scene(
        seed, {.cameras = 6, .fixed = 1, .points = 500, .noise = noise, .start_error = 0.1});
    add_common_errors(seed, wander, bend, scene.problem);
    (void)adjust_bundle(scene.problem, {.max_iterations = 20, .converged_relative_cost = 1e-7});
    const CameraCovariances found =
        camera_covariances(scene.problem, all_of(scene.problem), motions, SharedField::none);
    for (std::size_t i = 0; i < motions.size(); ++i) {
      const double nees = nees_of(scene, motions[i], found.covariances[i]);
      honesty.formal += share * nees_of(scene, motions[i], found.formal[i]);
      honesty.found += share * nees;
      honesty.covered += nees < kLimit95 ? share : 0;
    }
  }
  return honesty;
}

TEST(CameraCovariances, do_not_depend_on_the_standard_deviations_that_are_stated) {
  const Honesty honesty = assess(0.3, 0, 0);  // a third of the noise that is stated
  EXPECT_LT(honesty.formal, 0.15);
  EXPECT_GT(honesty.found, 0.8);
  EXPECT_LT(honesty.found, 1.25);
  EXPECT_GT(honesty.covered, 0.92);
}

TEST(CameraCovariances, are_honest_where_points_wander_with_the_view) {
  const Honesty honesty = assess(0.3, 0.5, 0);
  EXPECT_GT(honesty.formal, 1.5);
  EXPECT_GT(honesty.found, 0.8);
  EXPECT_LT(honesty.found, 1.25);
  EXPECT_GT(honesty.covered, 0.92);
}

TEST(CameraCovariances, are_honest_where_parts_of_the_image_err_together) {
  const Honesty honesty = assess(0.3, 0, 3);
  EXPECT_GT(honesty.formal, 0.2) << "more than the noise alone gives";
  EXPECT_GT(honesty.found, 0.6);
  EXPECT_LT(honesty.found, 1.25);
  EXPECT_GT(honesty.covered, 0.92);
}

TEST(CameraCovariances, an_observation_that_is_not_used_does_not_count) {
  const BundleScene scene = make_bundle_scene(3, {.cameras = 6, .fixed = 1, .points = 60});
  std::vector<char> use = all_of(scene.problem);
  for (std::size_t i = 0; i < use.size(); i += 3) use[i] = 0;
  BundleProblem fewer = scene.problem;
  fewer.observations.clear();
  for (std::size_t i = 0; i < use.size(); ++i)
    if (use[i] != 0) fewer.observations.push_back(scene.problem.observations[i]);
  const std::vector<CameraMotion> motions{{0, 5}};
  const auto by_flag = camera_covariances(scene.problem, use, motions, SharedField::none);
  const auto by_hand = camera_covariances(fewer, all_of(fewer), motions, SharedField::none);
  ASSERT_TRUE(by_flag.determined && by_hand.determined);
  EXPECT_EQ(by_flag.covariances, by_hand.covariances);
}

TEST(CameraCovariances, have_the_same_bits_at_any_number_of_threads) {
  const BundleScene scene = make_bundle_scene(3, {.cameras = 30, .fixed = 1, .points = 600});
  const std::vector<CameraMotion> motions{{0, 29}, {3, 4}};
  const auto one =
      camera_covariances(scene.problem, all_of(scene.problem), motions, SharedField::none, Executor(1));
  const auto three =
      camera_covariances(scene.problem, all_of(scene.problem), motions, SharedField::none, Executor(3));
  ASSERT_TRUE(one.determined);
  EXPECT_EQ(one.covariances, three.covariances);
  EXPECT_EQ(one.formal, three.formal);
}

TEST(CameraCovariances, are_not_determined_where_a_camera_can_move_freely) {
  BundleScene scene = make_bundle_scene(3, {.cameras = 6, .fixed = 1, .points = 60});
  const std::vector<CameraMotion> motions{{0, 5}};
  BundleProblem free = scene.problem, blind = scene.problem;
  free.camera_fixed[0] = 0;
  EXPECT_FALSE(camera_covariances(free, all_of(free), motions, SharedField::none).determined);
  std::erase_if(blind.observations, [](const BundleObservation& seen) { return seen.camera == 5; });
  EXPECT_FALSE(camera_covariances(blind, all_of(blind), motions, SharedField::none).determined);
  EXPECT_THROW((void)camera_covariances(scene.problem, all_of(scene.problem),
                                        std::vector<CameraMotion>{{0, 6}}, SharedField::none),
               PreconditionError);
}

TEST(CameraCovariances, the_adjoint_carries_a_perturbation_through_a_transform) {
  const Rigid3 transform{rotation_exp({0.3, -0.5, 1.1}), {1, -2, 3}};
  Vector6d xi;
  xi << 1e-6, -2e-6, 3e-6, 2e-6, 1e-6, -3e-6;
  const Rigid3 moved = transform * perturb_left(xi, {});
  EXPECT_LT((left_perturbation(transform, moved) - adjoint(transform) * xi).norm(), 1e-10);
}

}  // namespace
}  // namespace cairn
