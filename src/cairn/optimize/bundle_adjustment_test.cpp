// SPDX-License-Identifier: Apache-2.0
#include "cairn/optimize/bundle_adjustment.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "cairn/core/error.h"
#include "cairn/core/executor.h"
#include "cairn/testing/optimize/bundle_scene.h"
#include "cairn/testing/optimize/ceres_bundle.h"

namespace cairn {
namespace {

using testkit::BundleScene;
using testkit::BundleSceneOptions;
using testkit::CeresBundle;
using testkit::make_bundle_scene;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

BundleOptions precise(RobustKernel kernel = RobustKernel::huber) {
  return {.kernel = kernel, .max_iterations = 100, .converged_relative_cost = 1e-13};
}

/// Largest |left_perturbation| and largest distance of a point from the truth.
struct Errors {
  double camera = 0, point = 0;
};

Errors errors_of(const BundleScene& scene) {
  Errors errors;
  for (std::size_t i = 0; i < scene.true_cameras.size(); ++i)
    errors.camera = std::max(
        errors.camera, left_perturbation(scene.true_cameras[i], scene.problem.camera_from_world[i]).norm());
  for (std::size_t j = 0; j < scene.true_points.size(); ++j)
    errors.point = std::max(errors.point, (scene.true_points[j] - scene.problem.points_in_world[j]).norm());
  return errors;
}

bool same(const Rigid3& a, const Rigid3& b) {
  return a.rotation.coeffs() == b.rotation.coeffs() && a.translation == b.translation;
}

bool same(const BundleProblem& a, const BundleProblem& b) {
  return std::equal(a.camera_from_world.begin(), a.camera_from_world.end(), b.camera_from_world.begin(),
                    [](const Rigid3& x, const Rigid3& y) { return same(x, y); }) &&
         a.points_in_world == b.points_in_world;
}

TEST(BundleAdjustment, reaches_the_truth_without_noise) {
  for (const double disparity_share : {1.0, 0.5, 0.0}) {
    BundleScene scene = make_bundle_scene(1, {.disparity_share = disparity_share, .noise = 0});
    const BundleReport report = adjust_bundle(scene.problem, precise());
    EXPECT_EQ(report.status, BundleStatus::ok);
    EXPECT_LT(report.cost_after, 1e-12);
    EXPECT_LT(errors_of(scene).camera, 1e-7);
    EXPECT_LT(errors_of(scene).point, 1e-5);
    EXPECT_EQ(std::count(report.inlier.begin(), report.inlier.end(), 1),
              static_cast<std::ptrdiff_t>(report.inlier.size()));
  }
}

struct PeerCase {
  BundleSceneOptions scene;
  RobustKernel kernel = RobustKernel::none;
  double cost_tolerance = 1e-8, camera_tolerance = 2e-5;
};

void expect_agreement(const PeerCase& given, std::uint64_t seed) {
  BundleScene scene = make_bundle_scene(seed, given.scene);
  BundleOptions options = precise(given.kernel);
  CeresBundle peer(scene.problem);
  const CeresBundle::Costs theirs = peer.solve(options, CeresBundle::Schur::dense);
  const BundleReport report = adjust_bundle(scene.problem, options);
  EXPECT_NEAR(report.cost_before / theirs.initial, 1, 1e-12);
  EXPECT_LE(report.cost_after / theirs.final, 1 + given.cost_tolerance);
  constexpr double kEarlierStop = 1e-5;  // of Ceres, whose cost is the larger one then
  EXPECT_GE(report.cost_after / theirs.final, 1 - kEarlierStop);
  for (std::size_t i = 0; i < scene.true_cameras.size(); ++i)
    EXPECT_LT(left_perturbation(scene.problem.camera_from_world[i], peer.camera_from_world(i)).norm(),
              given.camera_tolerance);
}

TEST(BundleAdjustment, agrees_with_ceres) {
  const auto mono = BundleSceneOptions{.cameras = 12, .points = 200, .disparity_share = 0};
  auto mixed = mono, outliers = mono;
  mixed.disparity_share = outliers.disparity_share = 0.6;
  outliers.outlier_share = 0.1;
  outliers.outlier_px = 5;  // not so far that there are minima at infinity
  auto round_trip = mixed;  // whose cameras' equations are sparse
  round_trip.cameras = 60;
  round_trip.points = 600;
  // Huber's kernel goes the last steps to the minimum slowly, in Ceres as here: after 100 both are this near.
  const PeerCase slow{outliers, RobustKernel::huber, 2e-6, 1e-3};
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    for (const auto& scene : {mono, mixed, outliers, round_trip}) expect_agreement({scene}, seed);
    for (const auto& scene : {mono, mixed}) expect_agreement({scene, RobustKernel::huber}, seed);
    expect_agreement(slow, seed);
  }
}

TEST(BundleAdjustment, withstands_outliers) {
  const BundleSceneOptions options{.points = 300, .disparity_share = 0.5};
  BundleSceneOptions with_outliers = options;
  with_outliers.outlier_share = 0.1;
  BundleScene clean = make_bundle_scene(3, options), robust = make_bundle_scene(3, with_outliers);
  BundleScene plain = robust;
  (void)adjust_bundle(clean.problem, precise(RobustKernel::none));
  (void)adjust_bundle(plain.problem, precise(RobustKernel::none));
  const BundleReport report = adjust_bundle(robust.problem, precise());
  EXPECT_LT(errors_of(robust).camera, 2 * errors_of(clean).camera);
  EXPECT_GT(errors_of(plain).camera, 4 * errors_of(clean).camera);
  std::size_t right_kept = 0, wrong = 0, wrong_kept = 0;
  for (std::size_t i = 0; i < report.inlier.size(); ++i) {
    const auto& [camera, point, seen] = robust.problem.observations[i];
    const Eigen::Vector3d in_camera = robust.true_cameras[static_cast<std::size_t>(camera)] *
                                      robust.true_points[static_cast<std::size_t>(point)];
    const bool is_wrong = squared_error(robust.problem.rig, in_camera, seen) > 20 * 20;
    wrong += is_wrong ? 1U : 0U;
    (is_wrong ? wrong_kept : right_kept) += static_cast<std::size_t>(report.inlier[i]);
  }
  EXPECT_GT(wrong, report.inlier.size() / 20);
  EXPECT_LT(20 * wrong_kept, wrong);  // not none: a point of two pixels may explain a wrong one
  EXPECT_GT(right_kept, report.inlier.size() * 8 / 10);
}

TEST(BundleAdjustment, leaves_fixed_cameras_where_they_are) {
  BundleScene scene = make_bundle_scene(4);
  const BundleProblem before = scene.problem;
  (void)adjust_bundle(scene.problem, {});
  for (std::size_t i = 0; i < before.camera_fixed.size(); ++i)
    EXPECT_EQ(same(before.camera_from_world[i], scene.problem.camera_from_world[i]),
              before.camera_fixed[i] == 1)
        << i;
}

TEST(BundleAdjustment, adjusts_landmarks_alone_where_all_cameras_are_fixed) {
  BundleScene scene = make_bundle_scene(5, {.fixed = 8, .noise = 0});
  const BundleReport report = adjust_bundle(scene.problem, precise());
  EXPECT_EQ(report.status, BundleStatus::ok);
  EXPECT_LT(errors_of(scene).point, 1e-6);
}

TEST(BundleAdjustment, needs_no_fixed_camera) {
  BundleScene scene = make_bundle_scene(6, {.fixed = 0, .noise = 0});
  const BundleReport report = adjust_bundle(scene.problem, precise());
  EXPECT_EQ(report.status, BundleStatus::ok);
  EXPECT_LT(report.cost_after, 1e-9);
  const auto from_first = [](const std::vector<Rigid3>& cameras) {
    return cameras.back() * cameras.front().inverse();
  };
  EXPECT_LT(
      left_perturbation(from_first(scene.true_cameras), from_first(scene.problem.camera_from_world)).norm(),
      1e-5);
}

TEST(BundleAdjustment, repeats_its_bits_at_any_number_of_threads_and_order_of_observations) {
  const BundleScene scene =
      make_bundle_scene(7, {.cameras = 50, .points = 700, .disparity_share = 0.5, .outlier_share = 0.1});
  BundleProblem one = scene.problem;
  const BundleReport report = adjust_bundle(one, {});
  EXPECT_GT(report.cost_before, report.cost_after);
  for (const int threads : {2, 3}) {
    BundleProblem other = scene.problem;
    std::reverse(other.observations.begin(), other.observations.end());
    const Executor executor(threads);
    BundleReport again = adjust_bundle(other, {}, executor);
    std::reverse(again.inlier.begin(), again.inlier.end());
    EXPECT_TRUE(same(one, other)) << threads;
    EXPECT_EQ(again.cost_after, report.cost_after);
    EXPECT_EQ(again.inlier, report.inlier);
    const std::vector<char> all(other.observations.size(), 1);
    EXPECT_EQ(point_covariances(other, all), point_covariances(other, all, executor));
  }
}

TEST(BundleAdjustment, takes_a_landmark_with_one_observation_by_its_disparity) {
  BundleScene scene = make_bundle_scene(8, {.noise = 0});
  auto& [rig, cameras, fixed, points, observations, priors] = scene.problem;
  const Eigen::Vector3d stereo(0.3, 0.1, 4), mono(-0.4, 0.2, 5);
  points.push_back(cameras[0].inverse() * Eigen::Vector3d(0.4, 0.1, 4.5));
  points.push_back(cameras[5].inverse() * Eigen::Vector3d(-0.4, 0.3, 5));
  const Eigen::Vector3d undetermined = points.back();
  observations.push_back(
      {0, 100, {rig.project(stereo).x(), rig.project(stereo).y(), rig.project(stereo).z()}});
  observations.push_back({5, 101, {rig.project(mono).x(), rig.project(mono).y()}});
  const BundleReport report = adjust_bundle(scene.problem, precise(RobustKernel::none));
  EXPECT_EQ(report.status, BundleStatus::ok);
  EXPECT_LT((scene.problem.camera_from_world[0] * points[100] - stereo).norm(), 1e-6);
  EXPECT_EQ(points[101], undetermined);
  EXPECT_LT(errors_of(scene).camera, 1e-6);  // it does not pull at its camera, either
}

TEST(BundleAdjustment, leaves_observations_behind_their_camera_out) {
  BundleScene scene = make_bundle_scene(9);
  BundleProblem without = scene.problem;
  auto& problem = scene.problem;
  problem.points_in_world.push_back(problem.camera_from_world[3].inverse() * Eigen::Vector3d(0, 0, -2));
  for (const std::int32_t camera : {2, 3, 4}) problem.observations.push_back({camera, 100, {300, 200, 10}});
  const BundleReport expected = adjust_bundle(without, {});
  const BundleReport report = adjust_bundle(problem, {});
  EXPECT_EQ(report.cost_before, expected.cost_before);
  EXPECT_EQ(report.cost_after, expected.cost_after);
  for (std::size_t i = 0; i < without.camera_from_world.size(); ++i)
    EXPECT_TRUE(same(without.camera_from_world[i], problem.camera_from_world[i])) << i;
  for (std::size_t i = expected.inlier.size(); i < report.inlier.size(); ++i) EXPECT_EQ(report.inlier[i], 0);
}

/// A wrong match whose landmark is to be pulled through its cameras.
TEST(BundleAdjustment, survives_a_step_that_takes_a_landmark_behind_its_camera) {
  BundleScene scene = make_bundle_scene(10, {.noise = 0});
  auto& problem = scene.problem;
  problem.points_in_world.push_back(problem.camera_from_world[3].inverse() * Eigen::Vector3d(0, 0, 0.02));
  problem.observations.push_back({2, 100, {100, 200}});
  problem.observations.push_back({3, 100, {600, 200}});
  problem.observations.push_back({4, 100, {20, 400}});
  const BundleReport report = adjust_bundle(problem, precise());
  EXPECT_NE(report.status, BundleStatus::undetermined);
  EXPECT_LE(report.cost_after, report.cost_before);
  EXPECT_TRUE(problem.points_in_world.back().allFinite());
  EXPECT_LT(errors_of(scene).camera, 0.01);
}

TEST(BundleAdjustment, stays_finite_from_a_start_that_is_far_off) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    BundleScene scene = make_bundle_scene(
        seed, {.points = 40, .disparity_share = 0.5, .outlier_share = 0.2, .start_error = 30});
    const BundleReport report = adjust_bundle(scene.problem, {.max_iterations = 30});
    EXPECT_LE(report.cost_after, report.cost_before);
    EXPECT_TRUE(std::isfinite(report.cost_after));
    for (const Rigid3& pose : scene.problem.camera_from_world)
      EXPECT_TRUE(pose.rotation.coeffs().allFinite() && pose.translation.allFinite()) << seed;
    for (const auto& point : scene.problem.points_in_world) EXPECT_TRUE(point.allFinite()) << seed;
  }
}

TEST(BundleAdjustment, weighs_priors_against_observations) {
  BundleScene scene = make_bundle_scene(4, {});
  const Rigid3 mean = perturb_left(Vector6d::Constant(0.01), scene.true_cameras[3]);
  Matrix6d half = Matrix6d::Identity() * 300;
  half(1, 4) = half(2, 0) = 100;
  scene.problem.priors.push_back({3, mean, half * half.transpose()});
  const auto distance_to_mean = [&] {
    return left_perturbation(mean, scene.problem.camera_from_world[3]).norm();
  };
  const BundleReport report = adjust_bundle(scene.problem, precise());
  EXPECT_GT(distance_to_mean(), 1e-4);
  EXPECT_LT(distance_to_mean(), 0.02);
  for (Eigen::Index i = 0; i < 6; ++i) {  // the result is a minimum
    for (const double step : {-1e-4, 1e-4}) {
      BundleProblem moved = scene.problem;
      moved.camera_from_world[3] = perturb_left(step * Vector6d::Unit(i), moved.camera_from_world[3]);
      EXPECT_GT(adjust_bundle(moved, precise()).cost_before, report.cost_after);
    }
  }
  scene.problem.priors[0].information *= 1e8;
  (void)adjust_bundle(scene.problem, precise());
  EXPECT_LT(distance_to_mean(), 1e-6);
}

TEST(BundleAdjustment, refuses_two_priors_of_a_camera) {
  BundleScene scene = make_bundle_scene(4, {});
  scene.problem.priors.assign(2, {1, {}, {}});
  EXPECT_THROW((void)adjust_bundle(scene.problem, {}), PreconditionError);
  scene.problem.priors = {{99, {}, {}}};
  EXPECT_THROW((void)adjust_bundle(scene.problem, {}), PreconditionError);
}

TEST(BundleAdjustment, says_when_there_is_nothing_to_do) {
  BundleProblem empty;
  empty.rig = {525, 525, 320, 240, 0.1};
  EXPECT_EQ(adjust_bundle(empty, {}).status, BundleStatus::nothing_free);
  BundleScene scene = make_bundle_scene(11);
  EXPECT_EQ(adjust_bundle(scene.problem, {.max_iterations = 1}).status, BundleStatus::not_converged);
}

TEST(BundleAdjustment, leaves_cameras_and_points_without_observations_where_they_are) {
  BundleScene scene = make_bundle_scene(11);
  auto& observations = scene.problem.observations;
  std::erase_if(observations, [](const auto& seen) { return seen.camera == 6 || seen.point == 20; });
  const BundleProblem before = scene.problem;
  EXPECT_EQ(adjust_bundle(scene.problem, {}).status, BundleStatus::ok);
  EXPECT_LT(left_perturbation(before.camera_from_world[6], scene.problem.camera_from_world[6]).norm(), 1e-15);
  EXPECT_EQ(before.points_in_world[20], scene.problem.points_in_world[20]);
}

TEST(BundleAdjustment, refuses_what_makes_no_sense) {
  const BundleProblem good = make_bundle_scene(12).problem;
  const auto refused = [&](const auto& spoil) {
    BundleProblem bad = good;
    spoil(bad);
    EXPECT_THROW((void)adjust_bundle(bad, {}), PreconditionError);
  };
  refused([](BundleProblem& problem) { problem.camera_fixed.pop_back(); });
  refused([](BundleProblem& problem) { problem.observations[3].camera = 8; });
  refused([](BundleProblem& problem) { problem.observations[3].camera = -1; });
  refused([](BundleProblem& problem) { problem.observations[3].point = 100; });
  refused([](BundleProblem& problem) { problem.observations[3].seen.u = kNan; });
  refused([](BundleProblem& problem) { problem.observations[3].seen.sigma_px = 0; });
  refused([](BundleProblem& problem) { problem.points_in_world[7].y() = kNan; });
  refused([](BundleProblem& problem) { problem.camera_from_world[7].translation.x() = kNan; });
  refused([](BundleProblem& problem) { problem.observations.push_back(problem.observations[5]); });
  refused([](BundleProblem& problem) { problem.rig.fx = 0; });
  BundleProblem problem = good;
  EXPECT_THROW((void)adjust_bundle(problem, {.kernel_scale = 0}), PreconditionError);
  EXPECT_THROW((void)adjust_bundle(problem, {.max_iterations = 0}), PreconditionError);
  EXPECT_THROW((void)adjust_bundle(problem, {.converged_relative_cost = 0}), PreconditionError);
  EXPECT_THROW((void)point_covariances(problem, {}), PreconditionError);
}

/// Normalised estimation error squared of the points, cameras exact: 3 on average where it is honest.
TEST(PointCovariances, are_honest) {
  BundleScene scene =
      make_bundle_scene(13, {.cameras = 10, .fixed = 10, .points = 2000, .disparity_share = 0.7});
  ASSERT_EQ(adjust_bundle(scene.problem, precise(RobustKernel::none)).status, BundleStatus::ok);
  const std::vector<char> all(scene.problem.observations.size(), 1);
  const auto covariances = point_covariances(scene.problem, all);
  double nees = 0;
  std::size_t near = 0;  // the linear approximation holds where the depth is known to a few per cent
  for (std::size_t j = 0; j < covariances.size(); ++j) {
    const Eigen::Vector3d error = scene.problem.points_in_world[j] - scene.true_points[j];
    if (covariances[j].trace() > 0.1 * 0.1) continue;
    nees += error.dot(covariances[j].inverse() * error);
    ++near;
  }
  EXPECT_GT(near, 1000U);
  EXPECT_NEAR(nees / static_cast<double>(near), 3, 4 * std::sqrt(6.0 / static_cast<double>(near)));
}

TEST(PointCovariances, are_infinite_where_observations_do_not_determine_the_point) {
  BundleScene scene = make_bundle_scene(14, {.disparity_share = 0});
  std::vector<char> use(scene.problem.observations.size(), 0);
  use[0] = 1;  // the first point by one pixel, the others by nothing
  for (const auto& covariance : point_covariances(scene.problem, use)) {
    EXPECT_EQ(covariance(0, 0), std::numeric_limits<double>::infinity());
    EXPECT_EQ(covariance(1, 0), 0);
  }
  scene.problem.observations[0].seen.d = 40;
  const auto covariances = point_covariances(scene.problem, use);
  EXPECT_TRUE(covariances[0].allFinite());
  EXPECT_FALSE(covariances[1].allFinite());
}

}  // namespace
}  // namespace cairn
