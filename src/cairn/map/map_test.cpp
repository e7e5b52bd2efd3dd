// SPDX-License-Identifier: Apache-2.0
#include "cairn/map/map.h"

#include <gtest/gtest.h>

#include "cairn/core/error.h"

namespace cairn {
namespace {

constexpr KeyframeId kFirst{0}, kSecond{1}, kThird{2};

ObservedFrame frame_with_features(std::size_t count) {
  ObservedFrame frame;
  frame.frame = {5};
  frame.stamp_ns = 17;
  frame.observations.resize(count);
  frame.points_in_camera.resize(count);
  frame.features.keypoints.resize(count);
  return frame;
}

Rigid3 pose(double x) {
  return {rotation_exp({0, 0.1 * x, 0.3}), {x, 0, 0}};
}

/// Three keyframes of four features, a metre apart, each the parent of the next.
Map map_of_three() {
  Map map;
  for (std::int32_t k = 0; k < 3; ++k) (void)map.add_keyframe(frame_with_features(4), pose(k), {k - 1}, 0);
  return map;
}

void expect_near(const Rigid3& a, const Rigid3& b) {
  EXPECT_LT(motion_norm(a.inverse() * b), 1e-12);
}

TEST(Map, a_landmark_and_its_keyframes_know_each_other) {
  Map map = map_of_three();
  const LandmarkId landmark = map.add_landmark({1, 2, 3}, {kSecond, 2});
  map.add_observation(landmark, {kFirst, 3});
  EXPECT_EQ(map[kFirst].landmarks[3], landmark);
  EXPECT_EQ(map[kSecond].landmarks[2], landmark);
  EXPECT_EQ(map[landmark].observations, (std::vector<ObservationRef>{{kFirst, 3}, {kSecond, 2}}));
  EXPECT_EQ(map[landmark].point_in_world, Eigen::Vector3d(1, 2, 3));
}

TEST(Map, a_observation_ends_on_both_sides) {
  Map map = map_of_three();
  const LandmarkId landmark = map.add_landmark({0, 0, 0}, {kFirst, 0});
  map.add_observation(landmark, {kThird, 1});
  map.remove_observation(landmark, kFirst);
  map.remove_observation(landmark, kSecond);  // is none
  EXPECT_FALSE(map[kFirst].landmarks[0].valid());
  EXPECT_EQ(map[landmark].observations, (std::vector<ObservationRef>{{kThird, 1}}));
}

TEST(Map, a_landmark_without_observations_is_erased) {
  Map map = map_of_three();
  const LandmarkId gone = map.add_landmark({0, 0, 0}, {kFirst, 0});
  const LandmarkId stays = map.add_landmark({0, 0, 0}, {kFirst, 1});
  map.remove_observation(gone, kFirst);
  EXPECT_TRUE(map[gone].erased());
  EXPECT_EQ(map.landmark_ids(), (std::vector<LandmarkId>{stays}));
}

TEST(Map, an_erased_landmark_leaves_its_features_free) {
  Map map = map_of_three();
  const LandmarkId gone = map.add_landmark({0, 0, 0}, {kFirst, 0});
  map.add_observation(gone, {kSecond, 1});
  map.erase(gone);
  EXPECT_FALSE(map[kFirst].landmarks[0].valid());
  EXPECT_FALSE(map[kSecond].landmarks[1].valid());
  EXPECT_NO_THROW((void)map.add_landmark({0, 0, 0}, {kSecond, 1}));
}

TEST(Map, merging_takes_observations_over) {
  Map map = map_of_three();
  const LandmarkId kept = map.add_landmark({0, 0, 1}, {kFirst, 0});
  const LandmarkId gone = map.add_landmark({0, 0, 2}, {kSecond, 1});
  map.merge(gone, kept);
  EXPECT_TRUE(map[gone].erased());
  EXPECT_EQ(map[kSecond].landmarks[1], kept);
  EXPECT_EQ(map[kept].observations, (std::vector<ObservationRef>{{kFirst, 0}, {kSecond, 1}}));
  EXPECT_EQ(map[kept].point_in_world.z(), 1);
}

TEST(Map, merging_ends_the_second_observation_in_a_keyframe_that_shows_both) {
  Map map = map_of_three();
  const LandmarkId kept = map.add_landmark({0, 0, 0}, {kFirst, 0});
  const LandmarkId gone = map.add_landmark({0, 0, 0}, {kFirst, 1});
  map.add_observation(gone, {kSecond, 2});
  map.merge(gone, kept);
  EXPECT_EQ(map[kFirst].landmarks[0], kept);
  EXPECT_FALSE(map[kFirst].landmarks[1].valid());
  EXPECT_EQ(map[kept].observations, (std::vector<ObservationRef>{{kFirst, 0}, {kSecond, 2}}));
}

TEST(Map, an_erased_keyframe_shows_nothing) {
  Map map = map_of_three();
  const LandmarkId shared = map.add_landmark({0, 0, 0}, {kFirst, 0});
  map.add_observation(shared, {kSecond, 0});
  const LandmarkId own = map.add_landmark({0, 0, 0}, {kSecond, 1});
  map.erase(kSecond);
  EXPECT_TRUE(map[own].erased());
  EXPECT_EQ(map[shared].observations, (std::vector<ObservationRef>{{kFirst, 0}}));
  EXPECT_TRUE(map[kSecond].landmarks.empty());
  EXPECT_TRUE(map[kSecond].observed.observations.empty());
  EXPECT_EQ(map[kSecond].observed.frame, FrameId{5});
  EXPECT_EQ(map[kSecond].observed.stamp_ns, 17);
  EXPECT_EQ(map.keyframe_ids(), (std::vector<KeyframeId>{kFirst, kThird}));
}

TEST(Map, an_erased_keyframe_stays_where_it_was_and_moves_with_its_parent) {
  Map map = map_of_three();
  map.erase(kSecond);
  expect_near(map.world_from_camera(kSecond), pose(1));
  const Rigid3 moved{rotation_exp({0.4, 0, 0}), {0, 5, 0}};
  map.move(kFirst, moved * pose(0));
  expect_near(map.world_from_camera(kSecond), moved * pose(1));
}

TEST(Map, erased_keyframes_hang_on_each_other_in_any_order) {
  for (const auto& [one, other] : {std::pair{kSecond, kThird}, std::pair{kThird, kSecond}}) {
    Map map = map_of_three();
    map.erase(one);
    map.erase(other);
    expect_near(map.world_from_camera(kThird), pose(2));
    map.move(kFirst, pose(7));
    expect_near(map.world_from_camera(kThird), pose(7) * pose(0).inverse() * pose(2));
  }
}

TEST(Map, an_erased_keyframe_belongs_to_the_component_of_its_parent) {
  Map map = map_of_three();
  map.erase(kSecond);
  map.set_component(kFirst, 4);
  EXPECT_EQ(map.component_of(kSecond), 4);
  EXPECT_EQ(map.component_of(kThird), 0);
}

TEST(Map, corrected_disparities_move_landmarks_of_one_keyframe_and_stand_in_the_header) {
  const Rig rig{100, 100, 50, 50, 0.1};
  Map map(rig, "ORB");
  ObservedFrame frame = frame_with_features(3);
  frame.observations[0] = {50, 50, 4};
  frame.observations[1] = {70, 50, 4};
  frame.observations[2] = {50, 50, 1};
  for (std::size_t i = 0; i < 3; ++i) frame.points_in_camera[i] = point_in_camera(rig, frame.observations[i]);
  const KeyframeId first = map.add_keyframe(ObservedFrame(frame), pose(0), {}, 0);
  (void)map.add_keyframe(std::move(frame), pose(1), first, 0);
  const LandmarkId alone = map.add_landmark({0, 0, 1}, {first, 0}),
                   both = map.add_landmark({0, 0, 1}, {first, 1});
  map.add_observation(both, {kSecond, 1});
  map.correct_disparities({-0.5, 0, -1}, 2);  // sigmas of 1 px
  EXPECT_DOUBLE_EQ(map[first].observed.observations[0].d, 4.5);
  EXPECT_DOUBLE_EQ(map[kSecond].observed.observations[1].d, 4.54);  // x = 0.2
  EXPECT_FALSE(map[first].observed.observations[2].has_disparity());
  EXPECT_FALSE(map[first].observed.points_in_camera[2].allFinite());
  EXPECT_LT((map[alone].point_in_world - pose(0) * rig.point_at(50, 50, rig.depth(4.5))).norm(), 1e-12);
  EXPECT_EQ(map[both].point_in_world, Eigen::Vector3d(0, 0, 1));
  map.correct_disparities({0.25, 0, 0}, 2);
  EXPECT_EQ(map.header().right_correction->disparity, DisparityField(-0.25, 0, -1));
}

TEST(Map, a_feature_shows_one_landmark) {
  Map map = map_of_three();
  const LandmarkId landmark = map.add_landmark({0, 0, 0}, {kFirst, 0});
  EXPECT_THROW(map.add_observation(landmark, {kFirst, 1}), PreconditionError);
  (void)map.add_landmark({0, 0, 0}, {kSecond, 0});
  EXPECT_THROW(map.add_observation(landmark, {kSecond, 0}), PreconditionError);
  EXPECT_EQ(map[landmark].observations.size(), 1U);
  EXPECT_FALSE(map[kFirst].landmarks[1].valid());
}

TEST(Map, refuses_what_makes_no_sense) {
  Map map = map_of_three();
  const LandmarkId landmark = map.add_landmark({0, 0, 0}, {kFirst, 0});
  EXPECT_THROW(map.merge(landmark, landmark), PreconditionError);
  EXPECT_THROW(map.erase(kFirst), PreconditionError);
  EXPECT_THROW((void)map.add_keyframe(frame_with_features(1), {}, {3}, 0), PreconditionError);
}

/// Makes three keyframes of four features at a depth of 2 m; two of them show a landmark.
Map map_with_depths() {
  Map map(Rig{500, 500, 320, 240, 0.1}, "ORB");
  for (std::int32_t k = 0; k < 3; ++k) {
    ObservedFrame frame = frame_with_features(4);
    for (std::size_t i = 0; i < 4; ++i) {
      frame.observations[i] = {300, 200, 25, 1, 0.5};
      frame.points_in_camera[i] = point_in_camera(map.rig(), frame.observations[i]);
    }
    (void)map.add_keyframe(std::move(frame), pose(k), {k - 1}, 0);
  }
  const LandmarkId landmark = map.add_landmark({0, 0, 2}, {kFirst, 0});
  map.add_observation(landmark, {kSecond, 1});
  return map;
}

TEST(Map, a_disparity_can_be_wrong_alone) {
  Map map = map_with_depths();
  map.remove_disparity({0}, kSecond);
  EXPECT_FALSE(map[kSecond].observed.observations[1].has_disparity());
  EXPECT_FALSE(map[kSecond].observed.points_in_camera[1].allFinite());
  EXPECT_TRUE(map[kSecond].observed.observations[0].has_disparity());
  EXPECT_EQ(map[LandmarkId{0}].observations.size(), 2U);
  map.remove_disparity({0}, kThird);  // shows it not
  EXPECT_EQ(map[LandmarkId{0}].observations.size(), 2U);
}

TEST(Map, a_landmark_keeps_its_last_disparity) {
  Map map = map_with_depths();
  map.remove_disparity({0}, kSecond);
  map.remove_disparity({0}, kFirst);
  EXPECT_EQ(map[LandmarkId{0}].observations, (std::vector<ObservationRef>{{kSecond, 1}}));
  EXPECT_TRUE(map[kFirst].observed.observations[0].has_disparity());
}

TEST(Map, weighs_all_disparities) {
  Map map = map_with_depths();
  map.remove_disparity({0}, kSecond);
  map.weigh_disparities({0.3, 0.032});
  // the derivative of the disparity by the depth is d^2 / (fx b): 12.5 px per metre
  EXPECT_DOUBLE_EQ(map[kFirst].observed.observations[2].sigma_d_px, 0.5);
  EXPECT_FALSE(map[kSecond].observed.observations[1].has_disparity());
  ASSERT_TRUE(map.header().depth_noise);
  EXPECT_EQ(map.header().depth_noise->sigma_px, 0.3);
}

}  // namespace
}  // namespace cairn
