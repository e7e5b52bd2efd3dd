// SPDX-License-Identifier: Apache-2.0
#include "cairn/optimize/landmark_fit.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "cairn/core/error.h"
#include "cairn/simd/available.h"
#include "cairn/testing/optimize/landmark_scene.h"

namespace cairn {
namespace {

using testkit::LandmarkScene;
using testkit::make_landmark_scene;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

using Observations = std::vector<CameraObservation>;

/// The normal equations by plain matrices, from Rig alone.
struct PlainEquations {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  double squared_error = 0;
  double worst = -1;
  std::size_t worst_observation = 0;
};

PlainEquations plain_equations(const LandmarkScene& scene, const Observations& track,
                               const std::vector<char>& kept, const Eigen::Vector3d& point) {
  PlainEquations equations;
  for (std::size_t i = 0; i < track.size(); ++i) {
    if (kept[i] == 0) continue;
    const auto& [camera, seen] = track[i];
    const CameraFromWorld& pose = scene.cameras[static_cast<std::size_t>(camera)];
    const Eigen::Vector3d in_camera = pose * point;
    const Eigen::Vector3d error =
        scene.rig.project(in_camera) - Eigen::Vector3d(seen.u, seen.v, seen.has_disparity() ? seen.d : 0.0);
    const Eigen::Matrix3d jacobian = scene.rig.projection_jacobian(in_camera) * pose.matrix3();
    const Eigen::Matrix3d weights = inverse_variances(seen).asDiagonal();
    equations.information += jacobian.transpose() * weights * jacobian;
    equations.gradient += jacobian.transpose() * weights * error;
    const double squared = squared_error(scene.rig, in_camera, seen);
    equations.squared_error += squared;
    if (squared <= equations.worst) continue;
    equations.worst = squared;
    equations.worst_observation = i;
  }
  return equations;
}

/// Gauss-Newton to rounding from a start that is near.
Eigen::Vector3d plain_minimum(const LandmarkScene& scene, const Observations& track,
                              const std::vector<char>& kept, Eigen::Vector3d point) {
  for (int i = 0; i < 50; ++i) {
    const PlainEquations equations = plain_equations(scene, track, kept, point);
    point -= equations.information.ldlt().solve(equations.gradient);
  }
  return point;
}

/// The stated procedure: drop the worst and begin again.
std::vector<char> plain_kept(const LandmarkScene& scene, const Observations& track,
                             const Eigen::Vector3d& start, double max_error) {
  std::vector<char> kept(track.size(), 1);
  for (;;) {
    const PlainEquations at = plain_equations(scene, track, kept, plain_minimum(scene, track, kept, start));
    if (at.worst <= max_error * max_error) return kept;
    kept[at.worst_observation] = 0;
  }
}

struct Counted {
  int ok = 0, exactly_the_wrong_dropped = 0;
};

Counted count(const LandmarkScene& scene) {
  Counted counted;
  LandmarkSolver solver(scene.rig, scene.cameras);
  LandmarkFit fit;
  for (std::size_t i = 0; i < scene.tracks.size(); ++i) {
    solver.fit(scene.tracks[i], fit);
    std::vector<char> right;
    for (const char wrong : scene.wrong[i]) right.push_back(wrong == 0 ? 1 : 0);
    if (fit.status == LandmarkFitStatus::ok) ++counted.ok;
    if (fit.kept == right) ++counted.exactly_the_wrong_dropped;
  }
  return counted;
}

TEST(LandmarkFit, without_noise_it_is_the_truth) {
  for (const double share : {0.0, 0.5, 1.0}) {
    const LandmarkScene scene = make_landmark_scene(1, {.noise_px = 0, .disparity_share = share});
    for (std::size_t i = 0; i < scene.tracks.size(); ++i) {
      const LandmarkFit fit = fit_landmark(scene.rig, scene.cameras, scene.tracks[i]);
      ASSERT_EQ(fit.status, LandmarkFitStatus::ok);
      EXPECT_LT((fit.point_in_world - scene.points_in_world[i]).norm(), 1e-8);
      EXPECT_LT(fit.rms_px, 1e-9);
    }
  }
}

TEST(LandmarkFit, it_is_the_minimum_with_the_inverse_of_its_equations) {
  for (const double share : {0.0, 0.5, 1.0}) {
    const LandmarkScene scene = make_landmark_scene(2, {.disparity_share = share});
    for (std::size_t i = 0; i < scene.tracks.size(); ++i) {
      const Observations& track = scene.tracks[i];
      const std::vector<char> all(track.size(), 1);
      const LandmarkFit fit = fit_landmark(scene.rig, scene.cameras, track, {.max_error = 1e3});
      ASSERT_EQ(fit.status, LandmarkFitStatus::ok);
      EXPECT_EQ(fit.kept, all);
      const Eigen::Vector3d expected = plain_minimum(scene, track, all, scene.points_in_world[i]);
      EXPECT_LT((fit.point_in_world - expected).norm(), 1e-7) << i;
      const PlainEquations equations = plain_equations(scene, track, all, expected);
      const Eigen::Matrix3d covariance = equations.information.inverse();
      EXPECT_LT((fit.covariance - covariance).norm(), 1e-3 * covariance.norm());
      EXPECT_NEAR(fit.squared_error_sum, equations.squared_error, 1e-6 * equations.squared_error);
    }
  }
}

TEST(LandmarkFit, counts_what_was_measured) {
  LandmarkScene scene = make_landmark_scene(3, {.landmarks = 1, .shortest_track = 6, .longest_track = 6});
  Observations& track = scene.tracks[0];
  track[1].seen.d = kNan;
  track[4].seen.u += 50;
  const LandmarkFit fit = fit_landmark(scene.rig, scene.cameras, track);
  ASSERT_EQ(fit.status, LandmarkFitStatus::ok);
  EXPECT_EQ(fit.kept, (std::vector<char>{1, 1, 1, 1, 0, 1}));
  EXPECT_EQ(fit.redundancy, 4 * 3 + 2 - 3);
  double squared_px = 0;
  for (const std::size_t i : {0U, 1U, 2U, 3U, 5U}) {
    const auto& [camera, seen] = track[i];
    const Eigen::Vector3d pixels =
        scene.rig.project(scene.cameras[static_cast<std::size_t>(camera)] * fit.point_in_world);
    squared_px += (pixels.head<2>() - Eigen::Vector2d(seen.u, seen.v)).squaredNorm();
  }
  EXPECT_NEAR(fit.rms_px, std::sqrt(squared_px / 5), 1e-5);
}

TEST(LandmarkFit, covariances_are_honest) {
  const LandmarkScene scene = make_landmark_scene(4, {.landmarks = 4000, .disparity_share = 0.7});
  LandmarkSolver solver(scene.rig, scene.cameras);
  LandmarkFit fit;
  double squared_deviations = 0, squared_errors = 0;
  int redundancy = 0;
  for (std::size_t i = 0; i < scene.tracks.size(); ++i) {
    solver.fit(scene.tracks[i], fit);
    ASSERT_EQ(fit.status, LandmarkFitStatus::ok) << i;
    const Eigen::Vector3d error = fit.point_in_world - scene.points_in_world[i];
    squared_deviations += error.dot(fit.covariance.inverse() * error);
    squared_errors += fit.squared_error_sum;
    redundancy += fit.redundancy;
  }
  EXPECT_NEAR(squared_deviations / (3.0 * static_cast<double>(scene.tracks.size())), 1, 0.1);
  EXPECT_NEAR(squared_errors / redundancy, 1, 0.05);
}

TEST(LandmarkFit, drops_the_wrong_fifth) {
  const Counted counted =
      count(make_landmark_scene(5, {.landmarks = 1000, .shortest_track = 8, .outlier_share = 0.2}));
  EXPECT_GE(counted.ok, 990);
  EXPECT_GE(counted.exactly_the_wrong_dropped, 970);  // a thousandth of the right ones errs by 4 deviations
}

TEST(LandmarkFit, nearly_half_may_be_wrong) {
  const Counted stereo =
      count(make_landmark_scene(6, {.landmarks = 1000, .shortest_track = 10, .outlier_share = 0.4}));
  EXPECT_GE(stereo.exactly_the_wrong_dropped, 950);
  const Counted mono = count(make_landmark_scene(
      6, {.landmarks = 1000, .shortest_track = 20, .disparity_share = 0, .outlier_share = 0.4}));
  EXPECT_GE(mono.exactly_the_wrong_dropped, 950);
}

TEST(LandmarkFit, of_observations_that_are_all_wrong_hardly_three_agree) {
  const Counted counted = count(make_landmark_scene(
      7, {.landmarks = 500, .shortest_track = 6, .longest_track = 12, .outlier_share = 1}));
  EXPECT_LE(counted.ok, 25);
}

TEST(LandmarkFit, drops_what_the_stated_procedure_drops) {
  const LandmarkScene scene =
      make_landmark_scene(8, {.landmarks = 300, .shortest_track = 8, .outlier_share = 0.15, .outlier_px = 5});
  for (std::size_t i = 0; i < scene.tracks.size(); ++i) {
    const LandmarkFit fit = fit_landmark(scene.rig, scene.cameras, scene.tracks[i]);
    ASSERT_EQ(fit.kept, plain_kept(scene, scene.tracks[i], scene.points_in_world[i], 4)) << i;
  }
}

TEST(LandmarkFit, same_bits_on_all_instruction_sets_and_from_a_used_solver) {
  const LandmarkScene scene = make_landmark_scene(9, {.disparity_share = 0.6, .outlier_share = 0.15});
  for (const InstructionSet set : available_instruction_sets()) {
    LandmarkSolver solver(scene.rig, scene.cameras, {}, set);
    LandmarkFit fit;
    for (const Observations& track : scene.tracks) {
      solver.fit(track, fit);
      const LandmarkFit fresh = [&] {
        LandmarkSolver plain(scene.rig, scene.cameras, {}, InstructionSet::plain);
        LandmarkFit result;
        plain.fit(track, result);
        return result;
      }();
      ASSERT_EQ(fit.status, fresh.status);
      ASSERT_EQ(fit.point_in_world, fresh.point_in_world);
      ASSERT_EQ(fit.covariance, fresh.covariance);
      ASSERT_EQ(fit.squared_error_sum, fresh.squared_error_sum);
      ASSERT_EQ(fit.rms_px, fresh.rms_px);
      ASSERT_EQ(fit.kept, fresh.kept);
    }
  }
}

TEST(LandmarkFit, kilometres_from_the_origin_nothing_changes) {
  const Eigen::Vector3d place(4.1e6, -3e5, 4.8e6);
  const LandmarkScene near = make_landmark_scene(10, {}),
                      far = make_landmark_scene(10, {.place_in_world = place});
  for (std::size_t i = 0; i < near.tracks.size(); ++i) {
    const LandmarkFit a = fit_landmark(near.rig, near.cameras, near.tracks[i]);
    const LandmarkFit b = fit_landmark(far.rig, far.cameras, far.tracks[i]);
    ASSERT_EQ(a.status, b.status);
    EXPECT_LT((a.point_in_world + place - b.point_in_world).norm(), 1e-6);
    EXPECT_LT((a.covariance - b.covariance).norm(), 1e-6 * a.covariance.norm());
  }
}

TEST(LandmarkFit, far_points_are_honest_across_the_ray_or_undetermined) {
  for (const double share : {0.0, 1.0}) {
    const LandmarkScene scene = make_landmark_scene(
        11,
        {.landmarks = 1000, .longest_track = 6, .nearest = 200, .farthest = 20000, .disparity_share = share});
    int determined = 0, honest = 0, not_converged = 0;
    for (std::size_t i = 0; i < scene.tracks.size(); ++i) {
      const LandmarkFit fit = fit_landmark(scene.rig, scene.cameras, scene.tracks[i]);
      if (fit.status == LandmarkFitStatus::not_converged) ++not_converged;
      if (fit.status != LandmarkFitStatus::ok) continue;
      ++determined;
      EXPECT_TRUE(fit.covariance.allFinite());
      // depth errs by as much as itself; the direction does not, and sigma is its standard deviation times
      // depth
      const CameraFromWorld& camera = scene.cameras[static_cast<std::size_t>(scene.tracks[i].back().camera)];
      const Eigen::Vector3d found = camera * fit.point_in_world, truth = camera * scene.points_in_world[i];
      const Eigen::Vector3d across = found.unitOrthogonal(), in_world = camera.rotation.conjugate() * across;
      const double sigma = std::sqrt(in_world.dot(fit.covariance * in_world));
      if (std::abs(across.dot(truth) * found.norm() / truth.norm()) < 4 * sigma) ++honest;
    }
    EXPECT_GT(determined, 500);
    EXPECT_GT(honest, 0.98 * determined);
    EXPECT_LE(not_converged, 10);
  }
}

TEST(LandmarkFit, parallel_rays_do_not_determine_a_point) {
  LandmarkScene scene = make_landmark_scene(12, {.landmarks = 0});
  const Observation middle{.u = 600, .v = 200};
  const Observations thrice{{7, middle}, {7, middle}, {7, middle}};
  const LandmarkFit fit = fit_landmark(scene.rig, scene.cameras, thrice);
  EXPECT_EQ(fit.status, LandmarkFitStatus::undetermined);
  EXPECT_EQ(fit.covariance, Eigen::Matrix3d::Zero());
}

TEST(LandmarkFit, one_observation_with_disparity_is_back_projected) {
  const LandmarkScene scene = make_landmark_scene(13, {.landmarks = 0});
  const Observation seen{.u = 700, .v = 100, .d = 20};
  const Observations once{{3, seen}};
  const LandmarkFit fit = fit_landmark(scene.rig, scene.cameras, once, {.min_observations = 1});
  ASSERT_EQ(fit.status, LandmarkFitStatus::ok);
  EXPECT_EQ(fit.redundancy, 0);
  const Eigen::Vector3d pixels = scene.rig.project(scene.cameras[3] * fit.point_in_world);
  EXPECT_LT((pixels - Eigen::Vector3d(seen.u, seen.v, seen.d)).norm(), 1e-9);
  EXPECT_EQ(fit_landmark(scene.rig, scene.cameras, once).status, LandmarkFitStatus::too_few);
  EXPECT_EQ(fit_landmark(scene.rig, scene.cameras, {}).status, LandmarkFitStatus::too_few);
}

TEST(LandmarkFit, an_observation_by_a_camera_that_has_passed_is_dropped) {
  LandmarkScene scene = make_landmark_scene(14, {.landmarks = 50, .shortest_track = 8, .longest_track = 8});
  int count = 0;
  for (std::size_t i = 0; i < scene.tracks.size(); ++i) {
    Observations track = scene.tracks[i];
    track[2].camera =
        std::min(99, track[7].camera + 40);  // the landmark is at most 30 m ahead of the last one
    if (track[2].camera < track[7].camera + 31) continue;
    ++count;
    const LandmarkFit fit = fit_landmark(scene.rig, scene.cameras, track);
    ASSERT_EQ(fit.status, LandmarkFitStatus::ok);
    EXPECT_EQ(fit.kept[2], 0);
    EXPECT_LT((fit.point_in_world - scene.points_in_world[i]).norm(), 2);
  }
  EXPECT_GT(count, 10);
}

TEST(LandmarkFit, a_disparity_of_noise_below_zero_is_a_measurement) {
  LandmarkScene scene = make_landmark_scene(15, {.landmarks = 1, .shortest_track = 5, .longest_track = 5});
  for (CameraObservation& observation : scene.tracks[0]) {
    observation.seen.d = observation.camera % 2 == 0 ? -1 : 0;
    observation.seen.sigma_d_px = 100;
  }
  const LandmarkFit fit = fit_landmark(scene.rig, scene.cameras, scene.tracks[0]);
  ASSERT_EQ(fit.status, LandmarkFitStatus::ok);
  EXPECT_EQ(fit.redundancy, 12);
}

TEST(LandmarkFit, refuses_what_is_no_measurement) {
  const LandmarkScene scene = make_landmark_scene(16, {.landmarks = 1});
  const auto refused = [&](const CameraObservation& last) {
    Observations track = scene.tracks[0];
    track.back() = last;
    EXPECT_THROW((void)fit_landmark(scene.rig, scene.cameras, track), PreconditionError);
  };
  refused({100, {1, 1}});
  refused({-1, {1, 1}});
  refused({0, {kNan, 1}});
  refused({0, {1, 1, std::numeric_limits<double>::infinity()}});
  refused({0, {1, 1, kNan, 0}});
  refused({0, {1, 1, 10, 1, 0}});
  std::vector<CameraFromWorld> cameras = scene.cameras;
  cameras[5].translation.x() = kNan;
  EXPECT_THROW((void)fit_landmark(scene.rig, cameras, scene.tracks[0]), PreconditionError);
  EXPECT_THROW((void)fit_landmark({}, scene.cameras, scene.tracks[0]), PreconditionError);
  EXPECT_THROW((void)fit_landmark(scene.rig, scene.cameras, scene.tracks[0], {.max_error = 0}),
               PreconditionError);
}

}  // namespace
}  // namespace cairn
