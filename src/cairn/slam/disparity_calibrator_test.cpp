// SPDX-License-Identifier: Apache-2.0
#include "cairn/slam/disparity_calibrator.h"

#include <gtest/gtest.h>

#include "cairn/core/random.h"
#include "cairn/testing/geometry/camera_paths.h"
#include "cairn/testing/slam/map_maker.h"

namespace cairn {
namespace {

constexpr int kKeyframes = 14;
constexpr double kStep = 0.3;  // metres ahead
const Executor kOneThread(1);

/// Makes the map of a camera that drives straight past points, its disparities wrong by a field.
testkit::MapMaker drive(const DisparityField& error, double noise_px = 0.3) {
  testkit::PointWorld world;
  world.noise_px = noise_px;
  Random random(1, 0);
  for (int i = 0; i < 1500; ++i)
    world.add({random.uniform(-4, 4), random.uniform(-2, 2), random.uniform(3, 14)});
  testkit::MapMaker maker(world);
  for (int k = 0; k < kKeyframes; ++k) maker.add(testkit::ahead(kStep * k));
  maker.map.correct_disparities(-error, 0);
  return maker;
}

StereoNoise noise(const std::string& self_calibration) {
  StereoNoise noise;
  noise.self_calibration = self_calibration;
  noise.min_disparity_sigmas = 0;
  return noise;
}

double length_of(const Map& map) {
  const auto ids = map.keyframe_ids();
  return testkit::distance(map[ids.front()].world_from_camera, map[ids.back()].world_from_camera);
}

const DisparityField kError(-0.3, 0.1, -0.4);

TEST(DisparityCalibrator, a_planted_field_is_found_and_taken_off) {
  testkit::MapMaker maker = drive(kError);
  DisparityCalibrator calibrator(maker.map.rig(), noise("auto"), kOneThread);
  EXPECT_TRUE(calibrator.is_due(maker.map));
  const auto taken_off = calibrator.update(maker.map);
  ASSERT_TRUE(taken_off);
  const DisparityCalibration& result = calibrator.result();
  EXPECT_TRUE(result.applied);
  EXPECT_EQ(*taken_off, result.field);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(result.field[i], kError[i], 3 * result.sigma[i]) << "term " << i;
  EXPECT_NEAR(result.field[0], kError[0], 0.05);
  EXPECT_NEAR(length_of(maker.map), kStep * (kKeyframes - 1), 0.01 * kStep * kKeyframes);
  EXPECT_FALSE(calibrator.is_due(maker.map));
}

TEST(DisparityCalibrator, later_frames_are_corrected_as_the_map_is) {
  testkit::MapMaker maker = drive(kError);
  DisparityCalibrator calibrator(maker.map.rig(), noise("auto"), kOneThread);
  ObservedFrame before = maker.map[KeyframeId{3}].observed;
  (void)calibrator.update(maker.map);
  calibrator.correct(before);
  const ObservedFrame& in_map = maker.map[KeyframeId{3}].observed;
  ASSERT_EQ(before.observations.size(), in_map.observations.size());
  for (std::size_t i = 0; i < before.observations.size(); ++i)
    EXPECT_DOUBLE_EQ(before.observations[i].d, in_map.observations[i].d);
}

TEST(DisparityCalibrator, a_second_look_finds_the_same_field_and_takes_little_off) {
  testkit::MapMaker maker = drive(kError);
  DisparityCalibrator calibrator(maker.map.rig(), noise("auto"), kOneThread);
  const auto first = calibrator.update(maker.map), rest = calibrator.update(maker.map);
  ASSERT_TRUE(first && rest);
  EXPECT_LT(rest->norm(), 0.02 * first->norm());
  EXPECT_EQ(maker.map.header().right_correction->disparity, calibrator.result().field - kError);
  EXPECT_EQ(calibrator.result().estimates, 2);
}

TEST(DisparityCalibrator, nothing_is_done_where_nothing_is_wrong) {
  testkit::MapMaker maker = drive(DisparityField::Zero());
  DisparityCalibrator calibrator(maker.map.rig(), noise("auto"), kOneThread);
  EXPECT_FALSE(calibrator.update(maker.map));
  EXPECT_FALSE(calibrator.result().applied);
  EXPECT_LT(calibrator.result().rms_px, 0.05);
  EXPECT_TRUE(calibrator.result().is_determined());
}

TEST(DisparityCalibrator, report_finds_it_and_changes_nothing) {
  testkit::MapMaker maker = drive(kError);
  const double length = length_of(maker.map);
  DisparityCalibrator calibrator(maker.map.rig(), noise("report"), kOneThread);
  EXPECT_FALSE(calibrator.is_due(maker.map));
  EXPECT_FALSE(calibrator.update(maker.map));
  EXPECT_FALSE(calibrator.result().applied);
  EXPECT_NEAR(calibrator.result().field[0], kError[0], 0.05);
  EXPECT_EQ(length_of(maker.map), length);
}

TEST(DisparityCalibrator, off_does_not_look) {
  testkit::MapMaker maker = drive(kError);
  DisparityCalibrator calibrator(maker.map.rig(), noise("off"), kOneThread);
  EXPECT_FALSE(calibrator.is_due(maker.map));
  EXPECT_FALSE(calibrator.update(maker.map));
  EXPECT_EQ(calibrator.result().estimates, 0);
}

TEST(DisparityCalibrator, a_small_component_does_not_change_what_is_known) {
  testkit::MapMaker maker = drive(kError);
  DisparityCalibrator calibrator(maker.map.rig(), noise("auto"), kOneThread);
  (void)calibrator.update(maker.map);
  const DisparityField known = calibrator.result().field;
  const testkit::View elsewhere = maker.world.see(testkit::ahead(1), 100);
  for (int k = 0; k < 3; ++k) (void)maker.map.add_keyframe(ObservedFrame(elsewhere.observed), {}, {}, 1);
  (void)calibrator.update(maker.map);
  EXPECT_LT((calibrator.result().field - known).norm(), 0.01);
}

TEST(DisparityCalibrator, a_standing_camera_determines_nothing) {
  testkit::PointWorld world = drive(kError).world;
  testkit::MapMaker maker(world);
  for (int k = 0; k < kKeyframes; ++k) maker.add(testkit::ahead(0));
  maker.map.correct_disparities(-kError, 0);
  DisparityCalibrator calibrator(maker.map.rig(), noise("auto"), kOneThread);
  EXPECT_FALSE(calibrator.update(maker.map));
  EXPECT_FALSE(calibrator.result().is_determined());
  EXPECT_FALSE(calibrator.result().applied);
}

TEST(DisparityCalibrator, the_same_bits_at_any_number_of_threads) {
  testkit::MapMaker one = drive(kError), three = drive(kError);
  const Executor three_threads(3);
  EXPECT_EQ(DisparityCalibrator(one.map.rig(), noise("auto"), kOneThread).update(one.map),
            DisparityCalibrator(three.map.rig(), noise("auto"), three_threads).update(three.map));
  EXPECT_EQ(length_of(one.map), length_of(three.map));
}

}  // namespace
}  // namespace cairn
