// SPDX-License-Identifier: Apache-2.0
#include "cairn/optimize/disparity_noise_estimate.h"

#include <gtest/gtest.h>

#include <cmath>

#include "cairn/core/random.h"
#include "cairn/testing/optimize/bundle_scene.h"

namespace cairn {
namespace {

/// Returns points between 1.5 and 8 m, seen with a noise of the disparities, of which a share is wrong.
BundleProblem noisy_problem(const DisparityNoise& noise, double wrong_share = 0) {
  testkit::BundleSceneOptions options;
  options.cameras = 20;
  options.points = 800;
  options.noise = 0.7;
  testkit::BundleScene scene = testkit::make_bundle_scene(3, options);
  Random random(5, 0);
  for (BundleObservation& observation : scene.problem.observations) {
    const Rigid3& camera = scene.true_cameras[static_cast<std::size_t>(observation.camera)];
    const Eigen::Vector3d point = camera * scene.true_points[static_cast<std::size_t>(observation.point)];
    const double exact = scene.problem.rig.disparity(point.z());
    observation.seen.d = exact + noise.at(scene.problem.rig, exact) * random.normal();
    if (random.uniform() < wrong_share) observation.seen.d *= random.uniform(1.2, 2);
  }
  return scene.problem;
}

/// Adjusts and leaves out the disparities that do not fit, as a map does; no pixel is wrong.
void adjust(BundleProblem& problem) {
  const BundleReport report = adjust_bundle(problem, {});
  for (std::size_t i = 0; i < report.inlier.size(); ++i)
    if (report.inlier[i] == 0) problem.observations[i].seen = without_disparity(problem.observations[i].seen);
}

/// Adjusts and estimates as often as a map is, beginning with a standard deviation of 1 px.
std::optional<DisparityNoiseEstimate> estimate(BundleProblem problem) {
  weigh_disparities({1, 0}, problem);
  std::optional<DisparityNoiseEstimate> found;
  for (int round = 0; round < 5; ++round) {
    adjust(problem);
    found = estimate_disparity_noise(problem);
    if (!found) return found;
    weigh_disparities(found->noise, problem);
  }
  return found;
}

void expect_close(const DisparityNoise& found, const DisparityNoise& planted, double share) {
  const Rig rig = noisy_problem({1, 0}).rig;
  for (const double depth : {2.0, 4.0, 7.0})
    EXPECT_NEAR(found.of_depth(rig, depth), planted.of_depth(rig, depth),
                share * planted.of_depth(rig, depth))
        << depth << " m";
}

TEST(DisparityNoise, is_the_same_in_disparity_and_in_depth) {
  const Rig rig{500, 500, 320, 240, 0.08};
  const DisparityNoise noise{0.1, 0.01};
  for (const double depth : {0.5, 2.0, 6.0}) {
    const double d = rig.disparity(depth), step = 1e-6;
    const double per_px = (rig.depth(d - step) - rig.depth(d + step)) / (2 * step);
    EXPECT_NEAR(noise.of_depth(rig, depth), per_px * noise.at(rig, d), 1e-8);
  }
}

TEST(DisparityNoiseEstimate, finds_what_was_planted) {
  for (const DisparityNoise planted : {DisparityNoise{0.05, 0}, DisparityNoise{0.5, 0},
                                       DisparityNoise{0.02, 0.03}, DisparityNoise{0.15, 0.01}}) {
    const auto found = estimate(noisy_problem(planted));
    ASSERT_TRUE(found) << planted.sigma_px;
    expect_close(found->noise, planted, 0.12);
    EXPECT_GT(found->disparities, 1500);
  }
}

TEST(DisparityNoiseEstimate, wrong_disparities_count_little) {
  const DisparityNoise planted{0.1, 0.005};
  const auto found = estimate(noisy_problem(planted, 0.1));
  ASSERT_TRUE(found);
  expect_close(found->noise, planted, 0.4);
}

TEST(DisparityNoiseEstimate, says_nothing_of_few_or_of_points_seen_once) {
  testkit::BundleSceneOptions options;
  options.points = 20;
  EXPECT_FALSE(estimate_disparity_noise(testkit::make_bundle_scene(1, options).problem));
  BundleProblem once = noisy_problem({0.1, 0});
  std::vector<char> seen(once.points_in_world.size(), 0);
  std::erase_if(once.observations, [&](const BundleObservation& observation) {
    return std::exchange(seen[static_cast<std::size_t>(observation.point)], char{1}) != 0;
  });
  EXPECT_FALSE(estimate_disparity_noise(once));
}

TEST(DisparityNoiseEstimate, says_nothing_without_disparities) {
  BundleProblem problem = noisy_problem({0.1, 0});
  for (BundleObservation& observation : problem.observations)
    observation.seen = without_disparity(observation.seen);
  EXPECT_FALSE(estimate_disparity_noise(problem));
}

}  // namespace
}  // namespace cairn
