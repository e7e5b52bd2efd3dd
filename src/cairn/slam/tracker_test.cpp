// SPDX-License-Identifier: Apache-2.0
#include "cairn/slam/tracker.h"

#include <gtest/gtest.h>

#include "cairn/core/executor.h"
#include "cairn/testing/geometry/camera_paths.h"
#include "cairn/testing/slam/map_maker.h"

namespace cairn {
namespace {

/// A tracker that begins at a keyframe in the origin.
class TrackerTest : public testing::Test {
 protected:
  TrackerTest() {
    maker_.world.noise_px = 0.3;
    const KeyframeId first = maker_.add({});
    (void)tracker_.track(ObservedFrame(maker_.map[first].observed));
    tracker_.refer_to(first);
  }

  TrackingResult track(const Rigid3& truth) {
    return tracker_.track(maker_.world.see(truth, ++frame_).observed);
  }
  TrackingResult track_nothing() { return tracker_.track(testkit::blank_frame(0, ++frame_)); }

  [[nodiscard]] double error(const TrackingResult& track, const Rigid3& truth) const {
    const Rigid3 pose = maker_.map.world_from_camera(*track.reference) * track.reference_from_frame;
    return motion_norm(pose.inverse() * truth);
  }

  testkit::MapMaker maker_{testkit::points_ahead(600, 12)};
  SlamOptions options_;
  Executor executor_;
  Tracker tracker_{options_, executor_, maker_.indexed};
  std::int32_t frame_ = 0;
};

TEST_F(TrackerTest, follows_the_camera) {
  for (int k = 1; k <= 15; ++k) {
    const Rigid3 truth{rotation_exp({0, 0.01 * k, 0}), {0.02 * k, 0, 0.01 * k}};
    const TrackingResult seen = track(truth);
    ASSERT_TRUE(seen.tracked()) << k;
    EXPECT_LT(error(seen, truth), 4e-3) << k;
    EXPECT_EQ(*seen.reference, KeyframeId{0});
    EXPECT_EQ(seen.frame, FrameId{k});
    EXPECT_FALSE(seen.relocalized);
    EXPECT_GT(seen.inliers, 100);
  }
}

TEST_F(TrackerTest, finds_the_motion_without_a_prediction) {
  const Rigid3 truth{rotation_exp({0, 0.25, 0}), {0.1, 0, 0}};  // 130 pixels at once
  const TrackingResult seen = track(truth);
  ASSERT_TRUE(seen.tracked());
  EXPECT_LT(error(seen, truth), 3e-3);
}

TEST_F(TrackerTest, a_keyframe_is_due_when_the_view_has_changed) {
  EXPECT_EQ(track(testkit::aside(0.02)).status, TrackingStatus::tracked);
  EXPECT_EQ(track(testkit::aside(0.05)).status, TrackingStatus::tracked);
  EXPECT_EQ(track(testkit::aside(0.25)).status, TrackingStatus::keyframe);
}

TEST_F(TrackerTest, a_keyframe_is_due_when_little_is_left_to_follow) {
  options_.weak_inliers = 100000;
  EXPECT_EQ(track(testkit::aside(0.01)).status, TrackingStatus::tracked) << "nearly at rest";
  EXPECT_EQ(track(testkit::aside(0.05)).status, TrackingStatus::keyframe);
}

TEST_F(TrackerTest, is_lost_where_nothing_is_seen_and_finds_itself_again) {
  ASSERT_TRUE(track(testkit::aside(0.05)).tracked());
  const TrackingResult nothing = track_nothing();
  EXPECT_FALSE(nothing.tracked());
  EXPECT_EQ(nothing.status, TrackingStatus::lost);
  EXPECT_TRUE(tracker_.lost());
  const Rigid3 truth = testkit::aside(0.4);
  const TrackingResult again = track(truth);
  ASSERT_TRUE(again.tracked());
  EXPECT_TRUE(again.relocalized);
  EXPECT_FALSE(tracker_.lost());
  EXPECT_LT(error(again, truth), 3e-3);
  EXPECT_FALSE(track(testkit::aside(0.45)).relocalized);
}

TEST_F(TrackerTest, a_motion_of_max_motion_or_more_is_refused_by_whatever_way_it_is_found) {
  options_.max_motion = 0.15;
  ASSERT_TRUE(track(testkit::aside(0.1)).tracked());
  const TrackingResult far =
      track(testkit::aside(0.3));  // by the last motion, by the map, and by relocalisation
  EXPECT_FALSE(far.tracked());
  EXPECT_EQ(far.status, TrackingStatus::implausible);
  EXPECT_GT(far.inliers, 100) << "that it was seen well is known";
  EXPECT_TRUE(tracker_.lost());
  EXPECT_FALSE(track(testkit::aside(0.5)).tracked()) << "nor by being lost before";
  EXPECT_TRUE(track(testkit::aside(0.2)).tracked()) << "back where it may be";
}

TEST_F(TrackerTest, a_refused_frame_counts_as_a_step) {
  options_.max_motion = 0.15;
  options_.frame_period_s = 0.033;
  ASSERT_TRUE(track(testkit::aside(0.1)).tracked());
  EXPECT_FALSE(track(testkit::aside(0.35)).tracked());
  const TrackingResult again = track(testkit::aside(0.35));  // two steps of 0.125
  EXPECT_TRUE(again.tracked());
  EXPECT_TRUE(again.relocalized);
  for (int k = 1; k <= 5; ++k) EXPECT_EQ(track(testkit::aside(0.35 + 0.16 * k)).tracked(), false) << k;
}

TEST_F(TrackerTest, after_being_lost_max_loop_motion_holds_from_the_keyframe) {
  options_.max_loop_motion = 0.3;
  (void)track_nothing();
  EXPECT_FALSE(track(testkit::aside(0.4)).tracked());
  EXPECT_TRUE(track(testkit::aside(0.2)).tracked());
}

TEST_F(TrackerTest, moves_with_the_map) {
  ASSERT_TRUE(track(testkit::aside(0.05)).tracked());
  const Rigid3 before = tracker_.last().world_from_camera;
  const Rigid3 moved{rotation_exp({0, 0.8, 0}), {1, 2, 3}};
  Map& map = maker_.map;
  map.move(KeyframeId{0}, moved);
  for (const LandmarkId id : map.landmark_ids()) map.move(id, moved * map[id].point_in_world);
  tracker_.follow_map();
  EXPECT_LT(motion_norm(tracker_.last().world_from_camera.inverse() * moved * before), 1e-9);
  const TrackingResult seen = track(testkit::aside(0.1));
  ASSERT_TRUE(seen.tracked());
  EXPECT_FALSE(seen.relocalized);
  EXPECT_LT(error(seen, moved * testkit::aside(0.1)), 2e-3);
}

TEST_F(TrackerTest, refers_to_the_keyframe_that_the_last_frame_has_become) {
  const Rigid3 truth = testkit::aside(0.4);
  (void)track(truth);
  const Rigid3 before = tracker_.last().world_from_camera;
  const KeyframeId second = maker_.add(truth, before);  // the frame that was tracked: number 1
  tracker_.refer_to(second);
  EXPECT_EQ(tracker_.reference(), second);
  EXPECT_LT(motion_norm(tracker_.last().world_from_camera.inverse() * before), 1e-12);
  EXPECT_EQ(tracker_.last().landmarks, maker_.map[second].landmarks);
}

TEST_F(TrackerTest, passes_over_landmarks_that_were_erased_meanwhile) {
  (void)track(testkit::aside(0.05));
  Map& map = maker_.map;
  for (const LandmarkId id : map.landmark_ids())
    if (id.value % 2 == 0) map.erase(id);
  const TrackingResult seen = track(testkit::aside(0.1));
  ASSERT_TRUE(seen.tracked());
  EXPECT_LT(error(seen, testkit::aside(0.1)), 2e-3);
  for (const LandmarkId id : tracker_.last().landmarks)
    if (id.valid()) {
      EXPECT_FALSE(map[id].erased());
    }
}

/// Returns points of which only `unique` have a look of their own; the others look like some dozens of
/// others.
testkit::PointWorld mostly_alike(std::size_t unique) {
  testkit::PointWorld world = testkit::points_ahead(600, 12);
  for (std::size_t i = unique; i < world.points.size(); ++i) world.points[i].look = unique + i % 20;
  return world;
}

TEST(Tracker, a_guess_by_few_descriptors_is_searched_around) {
  testkit::MapMaker maker(mostly_alike(18));
  const SlamOptions options;
  const Executor executor;
  Tracker tracker(options, executor, maker.indexed);
  const KeyframeId first = maker.add({});
  (void)tracker.track(ObservedFrame(maker.map[first].observed));
  tracker.refer_to(first);
  const Rigid3 truth{rotation_exp({0, 0.25, 0}), {0.1, 0, 0}};  // 130 pixels at once
  ObservedFrame frame = maker.world.see(truth, 1).observed;
  const Motion motion = estimate_motion(
      maker.map.rig(), {maker.map[first].observed, points_of(maker.map, first)}, frame, options);
  ASSERT_FALSE(motion.found);
  ASSERT_TRUE(motion.is_guess);
  const TrackingResult seen = tracker.track(std::move(frame));
  ASSERT_TRUE(seen.tracked());
  EXPECT_GT(seen.inliers, 100);
  EXPECT_LT(motion_norm((maker.map.world_from_camera(*seen.reference) * seen.reference_from_frame).inverse() *
                        truth),
            3e-3);
}

TEST(Tracker, without_a_map_nothing_is_tracked) {
  const SlamOptions options;
  const Executor executor;
  const IndexedMap map(Map(testkit::kWorldRig, "ORB"));
  Tracker tracker(options, executor, map);
  EXPECT_FALSE(tracker.track(testkit::points_ahead(300, 1).see({}, 0).observed).tracked());
  EXPECT_TRUE(tracker.lost());
}

}  // namespace
}  // namespace cairn
