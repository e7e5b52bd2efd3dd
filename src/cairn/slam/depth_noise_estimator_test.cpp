// SPDX-License-Identifier: Apache-2.0
#include "cairn/slam/depth_noise_estimator.h"

#include <gtest/gtest.h>

#include "cairn/core/random.h"
#include "cairn/slam/window.h"
#include "cairn/testing/geometry/camera_paths.h"
#include "cairn/testing/slam/map_maker.h"

namespace cairn {
namespace {

constexpr int kKeyframes = 6;
constexpr double kPlantedPx = 0.1;

/// Makes the map of a camera that drives past points whose disparities have noise of kPlantedPx.
testkit::MapMaker drive() {
  testkit::PointWorld world;
  world.noise_px = 10 * kPlantedPx;  // d has a tenth of it
  Random random(1, 0);
  for (int i = 0; i < 600; ++i)
    world.add({random.uniform(-4, 4), random.uniform(-2, 2), random.uniform(3, 14)});
  testkit::MapMaker maker(world);
  for (int k = 0; k < kKeyframes; ++k) maker.add(testkit::ahead(0.2 * k));
  Window whole = whole_component(maker.map, 0);
  apply_adjustment(whole, adjust_bundle(whole.problem, {}), maker.map);
  return maker;
}

TEST(DepthNoiseEstimator, weighs_the_map_by_its_residuals) {
  testkit::MapMaker maker = drive();
  DepthNoiseEstimator estimator(maker.map, {});
  EXPECT_EQ(estimator.result().disparities, 0);
  EXPECT_TRUE(estimator.is_due(maker.map));
  const auto noise = estimator.update(maker.map);
  ASSERT_TRUE(noise);
  const double typical = noise->at(maker.map.rig(), maker.map.rig().disparity(7));
  EXPECT_NEAR(typical, kPlantedPx, 0.25 * kPlantedPx);
  EXPECT_GT(estimator.result().disparities, 500);
  const Observation& seen = maker.map[KeyframeId{0}].observed.observations.front();
  EXPECT_DOUBLE_EQ(seen.sigma_d_px, noise->at(maker.map.rig(), seen.d));
  EXPECT_FALSE(estimator.is_due(maker.map));
}

TEST(DepthNoiseEstimator, weighs_later_frames_as_the_map) {
  testkit::MapMaker maker = drive();
  DepthNoiseEstimator estimator(maker.map, {});
  const auto noise = estimator.update(maker.map);
  ObservedFrame frame = maker.world.see(testkit::ahead(1.5), kKeyframes).observed;
  estimator.weigh(frame);
  for (const Observation& seen : frame.observations) {
    if (!seen.has_disparity()) continue;
    EXPECT_DOUBLE_EQ(seen.sigma_d_px, noise->at(maker.map.rig(), seen.d));
  }
}

TEST(DepthNoiseEstimator, keeps_what_is_stated) {
  testkit::MapMaker maker = drive();
  DepthNoise stated;
  stated.stated.sigma_px = 0.2;
  DepthNoiseEstimator estimator(maker.map, stated);
  EXPECT_FALSE(estimator.is_due(maker.map));
  EXPECT_FALSE(estimator.update(maker.map));
  EXPECT_EQ(estimator.result().noise.sigma_px, 0.2);
  EXPECT_EQ(estimator.finish(maker.map).sigma_px, 0.2);
  ASSERT_TRUE(maker.map.header().depth_noise);
  EXPECT_EQ(maker.map.header().depth_noise->sigma_px, 0.2);
}

TEST(DepthNoiseEstimator, begins_with_that_of_a_map_that_goes_on) {
  testkit::MapMaker maker = drive();
  maker.map.weigh_disparities({0.07, 0.002});
  const DepthNoiseEstimator estimator(maker.map, {});
  EXPECT_EQ(estimator.result().noise.sigma_px, 0.07);
  EXPECT_EQ(estimator.result().noise.sigma_m, 0.002);
}

TEST(DepthNoiseEstimator, an_empty_map_says_nothing) {
  Map map(testkit::kWorldRig, "ORB");
  DepthNoiseEstimator estimator(map, {});
  EXPECT_FALSE(estimator.is_due(map));
  EXPECT_FALSE(estimator.update(map));
  EXPECT_EQ(estimator.finish(map).sigma_px, DepthNoise().at_start().sigma_px);
  EXPECT_TRUE(map.header().depth_noise);
}

}  // namespace
}  // namespace cairn
