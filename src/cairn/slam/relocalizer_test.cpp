// SPDX-License-Identifier: Apache-2.0
#include "cairn/slam/relocalizer.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "cairn/core/executor.h"
#include "cairn/core/random.h"
#include "cairn/testing/geometry/camera_paths.h"
#include "cairn/testing/slam/map_maker.h"

namespace cairn {
namespace {

Map row_of(std::int32_t count) {
  Map map(testkit::kWorldRig, "ORB");
  for (std::int32_t k = 0; k < count; ++k) (void)map.add_keyframe(testkit::blank_frame(0), {}, {k - 1}, 0);
  return map;
}

TEST(CandidateKeyframes, come_nearest_first) {
  EXPECT_EQ(candidate_keyframes(row_of(10), {6}, 3, 0, 1, 0), (std::vector<KeyframeId>{{5}, {4}, {3}}));
  EXPECT_EQ(candidate_keyframes(row_of(10), {2}, 3, 0, 1, 0), (std::vector<KeyframeId>{{1}, {0}}));
  EXPECT_TRUE(candidate_keyframes(row_of(10), {0}, 3, 3, 1, 0).empty());
}

TEST(CandidateKeyframes, pass_over_erased_ones) {
  Map map = row_of(10);
  map.erase(KeyframeId{4});
  EXPECT_EQ(candidate_keyframes(map, {6}, 3, 0, 1, 0), (std::vector<KeyframeId>{{5}, {3}, {2}}));
}

TEST(CandidateKeyframes, draw_others_without_replacement) {
  const Map map = row_of(30);
  auto drawn = candidate_keyframes(map, {25}, 5, 8, 1, 0);
  ASSERT_EQ(drawn.size(), 13U);
  EXPECT_TRUE(std::all_of(drawn.begin() + 5, drawn.end(), [](KeyframeId id) { return id < KeyframeId{20}; }));
  std::sort(drawn.begin(), drawn.end());
  EXPECT_EQ(std::unique(drawn.begin(), drawn.end()), drawn.end());
  auto all = candidate_keyframes(map, {25}, 5, 100, 1, 0);
  EXPECT_EQ(all.size(), 25U);
}

TEST(CandidateKeyframes, depend_on_seed_and_stream_alone) {
  const Map map = row_of(100);
  const auto drawn = candidate_keyframes(map, {100}, 0, 10, 1, 7);
  EXPECT_EQ(candidate_keyframes(map, {100}, 0, 10, 1, 7), drawn);
  EXPECT_NE(candidate_keyframes(map, {100}, 0, 10, 2, 7), drawn);
  EXPECT_NE(candidate_keyframes(map, {100}, 0, 10, 1, 8), drawn);
}

/// Thirty keyframes past a wall of points.
struct PastAWall {
  PastAWall() {
    for (std::int32_t k = 0; k < 30; ++k) (void)maker.add(testkit::aside(0.6 * k));
  }
  static testkit::PointWorld wall() {
    testkit::PointWorld world;
    Random random(6);
    for (int i = 0; i < 3000; ++i)
      world.add({random.uniform(-2, 20), random.uniform(-1, 1), random.uniform(2, 3)});
    world.noise_px = 0.3;
    return world;
  }
  testkit::MapMaker maker{wall()};
  SlamOptions options;
};

TEST(Relocalize, finds_a_frame_anywhere_in_the_map) {
  PastAWall scene;
  scene.options.relocalization_keyframes = 1;  // so that the place has to be recognised
  for (const double x : {0.4, 8.1, 17.3}) {
    const Rigid3 truth = testkit::aside(x) * Rigid3{rotation_exp({0.02, 0.1, 0.05}), {0, 0.1, 0.1}};
    const testkit::View view = scene.maker.world.see(truth, 100);
    const auto found = relocalize(scene.maker.indexed, view.observed, scene.options, Executor(2));
    ASSERT_TRUE(found) << x;
    EXPECT_LT(motion_norm(found->tracked.world_from_camera.inverse() * truth), 6e-3) << x;
    EXPECT_NEAR(0.6 * found->keyframe.value, truth.translation.x(), 1);
    int right = 0, shown = 0;
    for (std::size_t i = 0; i < view.points.size(); ++i) {
      const LandmarkId id = found->tracked.landmarks[i];
      shown += id.valid() ? 1 : 0;
      right += id.valid() && id == scene.maker.known[view.points[i]].landmark ? 1 : 0;
    }
    EXPECT_GT(shown, 150);
    EXPECT_GE(right, shown - 2);
  }
}

TEST(Relocalize, is_the_same_at_any_number_of_threads) {
  const PastAWall scene;
  const testkit::View view = scene.maker.world.see(testkit::aside(3.3), 100);
  const auto one = relocalize(scene.maker.indexed, view.observed, scene.options, Executor(1));
  const auto many = relocalize(scene.maker.indexed, view.observed, scene.options, Executor(3));
  ASSERT_TRUE(one && many);
  EXPECT_EQ(one->keyframe, many->keyframe);
  EXPECT_EQ(one->tracked.world_from_camera.translation, many->tracked.world_from_camera.translation);
  EXPECT_EQ(one->tracked.landmarks, many->tracked.landmarks);
}

TEST(Relocalize, finds_nothing_in_a_strange_place) {
  PastAWall scene;
  for (testkit::WorldPoint& point : scene.maker.world.points) point.look += 100000;
  const testkit::View view = scene.maker.world.see(testkit::aside(3.3), 100);
  EXPECT_FALSE(relocalize(scene.maker.indexed, view.observed, scene.options, Executor(2)));
}

/// The looks are all there, each at a point where it does not belong.
TEST(Relocalize, is_not_taken_in_by_looks_alone) {
  PastAWall scene;
  auto& points = scene.maker.world.points;
  Random random(8);
  for (std::size_t i = points.size(); i > 1; --i)
    std::swap(points[i - 1].look, points[random.index(static_cast<std::uint32_t>(i))].look);
  const testkit::View view = scene.maker.world.see(testkit::aside(3.3), 100);
  EXPECT_FALSE(relocalize(scene.maker.indexed, view.observed, scene.options, Executor(2)));
}

}  // namespace
}  // namespace cairn
