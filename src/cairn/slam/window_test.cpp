// SPDX-License-Identifier: Apache-2.0
#include "cairn/slam/window.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "cairn/core/random.h"
#include "cairn/testing/geometry/camera_paths.h"
#include "cairn/testing/slam/map_maker.h"

namespace cairn {
namespace {

/// Eight keyframes in a row, half a metre apart, along a wall of points.
testkit::MapMaker along_a_wall() {
  testkit::PointWorld world;
  Random random(4);
  for (int i = 0; i < 900; ++i)
    world.add({random.uniform(-2, 6), random.uniform(-1, 1), random.uniform(2, 2.5)});
  testkit::MapMaker maker(world);
  for (int k = 0; k < 8; ++k) (void)maker.add(testkit::aside(0.5 * k));
  return maker;
}

MappingOptions small_window() {
  MappingOptions options;
  options.window_keyframes = 3;
  options.window_fixed = 2;
  return options;
}

std::vector<KeyframeId> cameras_that_are(bool fixed, const Window& window) {
  std::vector<KeyframeId> ids;
  for (std::size_t c = 0; c < window.cameras.size(); ++c)
    if ((window.problem.camera_fixed[c] != 0) == fixed) ids.push_back(window.cameras[c]);
  std::sort(ids.begin(), ids.end());
  return ids;
}

TEST(Window, the_keyframe_and_its_neighbours_are_free_and_the_next_ones_hold_them) {
  const testkit::MapMaker maker = along_a_wall();
  const Window window = window_around(maker.map, {7}, small_window());
  EXPECT_EQ(cameras_that_are(false, window), (std::vector<KeyframeId>{{5}, {6}, {7}}));
  EXPECT_EQ(cameras_that_are(true, window), (std::vector<KeyframeId>{{3}, {4}}));
}

TEST(Window, the_oldest_is_held_where_no_other_is) {
  const testkit::MapMaker maker = along_a_wall();
  MappingOptions options = small_window();
  options.window_keyframes = 100;
  const Window window = window_around(maker.map, {3}, options);
  EXPECT_EQ(cameras_that_are(true, window), (std::vector<KeyframeId>{{0}}));
}

TEST(Window, has_all_that_its_free_keyframes_show) {
  const testkit::MapMaker maker = along_a_wall();
  const Map& map = maker.map;
  const Window window = window_around(map, {7}, small_window());
  std::set<LandmarkId> shown;
  std::size_t observations = 0;
  for (const KeyframeId id : cameras_that_are(false, window))
    for (const LandmarkId landmark : map[id].landmarks) shown.insert(landmark);
  for (const LandmarkId landmark : shown)
    for (const ObservationRef& observation : map[landmark].observations)
      observations += observation.keyframe.value >= 3 ? 1 : 0;
  EXPECT_EQ(std::set<LandmarkId>(window.points.begin(), window.points.end()), shown);
  EXPECT_EQ(window.points.size(), shown.size());
  EXPECT_EQ(window.problem.observations.size(), observations);
}

TEST(Window, is_what_the_map_says) {
  const testkit::MapMaker maker = along_a_wall();
  const Window window = window_around(maker.map, {7}, small_window());
  EXPECT_FALSE(window.problem.observations.empty());
  for (const BundleObservation& observation : window.problem.observations) {
    const Rigid3& camera = window.problem.camera_from_world[static_cast<std::size_t>(observation.camera)];
    const Eigen::Vector3d& point =
        window.problem.points_in_world[static_cast<std::size_t>(observation.point)];
    EXPECT_LT(squared_error(window.problem.rig, camera * point, observation.seen), 1e-12);
  }
}

TEST(Window, the_whole_of_a_component_leaves_other_components_and_single_observations_out) {
  testkit::MapMaker maker = along_a_wall();
  Map& map = maker.map;
  const KeyframeId other = map.add_keyframe(testkit::blank_frame(2), {}, {}, 1);
  (void)map.add_landmark({0, 0, 0}, {other, 0});
  const Window window = whole_component(map, 0);
  EXPECT_EQ(cameras_that_are(true, window), (std::vector<KeyframeId>{{0}}));
  EXPECT_EQ(cameras_that_are(false, window).size(), 7U);
  std::size_t seen_again = 0;
  for (const LandmarkId id : map.landmark_ids()) seen_again += map[id].observations.size() > 1 ? 1 : 0;
  EXPECT_EQ(window.points.size(), seen_again);
  EXPECT_GT(seen_again, 300U);
}

TEST(TakeOver, moves_what_is_free_and_ends_observations_that_do_not_agree) {
  testkit::MapMaker maker = along_a_wall();
  Map& map = maker.map;
  Window window = window_around(map, {7}, small_window());
  BundleReport report;
  report.inlier.assign(window.problem.observations.size(), 1);
  report.inlier[10] = 0;
  const BundleObservation bad = window.problem.observations[10];
  const auto landmark = window.points[static_cast<std::size_t>(bad.point)];
  const auto keyframe = window.cameras[static_cast<std::size_t>(bad.camera)];
  const std::size_t observations = map[landmark].observations.size();
  for (Rigid3& camera : window.problem.camera_from_world) camera.translation.y() += 1;
  for (Eigen::Vector3d& point : window.problem.points_in_world) point.y() -= 2;
  const Eigen::Vector3d before = map[landmark].point_in_world;
  apply_adjustment(window, report, map);
  EXPECT_EQ(map[landmark].observations.size(), observations - 1);
  EXPECT_EQ(std::count(map[keyframe].landmarks.begin(), map[keyframe].landmarks.end(), landmark), 0);
  EXPECT_NEAR(map[landmark].point_in_world.y(), before.y() - 2, 1e-12);
  EXPECT_NEAR(map[KeyframeId{6}].world_from_camera.translation.y(), -1, 1e-12);
  EXPECT_NEAR(map[KeyframeId{4}].world_from_camera.translation.y(), 0, 1e-12) << "is held";
}

/// The window's adjustment as a whole: keyframes and landmarks that were moved aside come back.
TEST(TakeOver, an_adjusted_window_is_nearer_to_the_truth) {
  testkit::MapMaker maker = along_a_wall();
  Map& map = maker.map;
  for (const std::int32_t k : {5, 6, 7})
    map.move(KeyframeId{k}, Rigid3{rotation_exp({0, 0.01, 0}), {0.02, 0, 0}} * testkit::aside(0.5 * k));
  Window window = window_around(map, {7}, small_window());
  const BundleReport report = adjust_bundle(window.problem, {});
  apply_adjustment(window, report, map);
  for (const std::int32_t k : {5, 6, 7})
    EXPECT_LT(motion_norm(map[KeyframeId{k}].world_from_camera.inverse() * testkit::aside(0.5 * k)), 1e-3);
}

TEST(TakeOver, a_wrong_disparity_is_taken_away_and_its_pixel_stays) {
  testkit::MapMaker maker = along_a_wall();
  Window window = window_around(maker.map, {7}, small_window());
  BundleReport report;
  report.inlier.assign(window.problem.observations.size(), 1);
  BundleObservation& wrong = window.problem.observations[0];
  wrong.seen.d += 20;
  report.inlier[0] = 0;
  const LandmarkId landmark = window.points[static_cast<std::size_t>(wrong.point)];
  const KeyframeId keyframe = window.cameras[static_cast<std::size_t>(wrong.camera)];
  const std::size_t observations = maker.map[landmark].observations.size();
  ASSERT_GT(observations, 1U);
  apply_adjustment(window, report, maker.map);
  ASSERT_EQ(maker.map[landmark].observations.size(), observations);
  for (const ObservationRef& seen : maker.map[landmark].observations)
    EXPECT_EQ(maker.map[seen.keyframe]
                  .observed.observations[static_cast<std::size_t>(seen.feature)]
                  .has_disparity(),
              seen.keyframe != keyframe);
}

}  // namespace
}  // namespace cairn
