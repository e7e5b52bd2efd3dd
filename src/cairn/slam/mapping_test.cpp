// SPDX-License-Identifier: Apache-2.0
#include "cairn/slam/mapping.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "cairn/testing/geometry/camera_paths.h"
#include "cairn/testing/slam/map_maker.h"

namespace cairn {
namespace {

TEST(AddKeyframe, shows_the_landmarks_it_was_tracked_by) {
  IndexedMap indexed(Map(testkit::kWorldRig, "ORB"));
  Map& map = indexed.edit();
  const KeyframeId first = indexed.add_keyframe(testkit::blank_frame(4), {}, {}, 0);
  const LandmarkId seen = map.add_landmark({0, 0, 0}, {first, 0}),
                   gone = map.add_landmark({0, 0, 0}, {first, 1});
  map.erase(gone);
  FramePose tracked;
  tracked.world_from_camera = testkit::aside(2);
  tracked.landmarks = {{}, seen, gone, seen};  // as a landmark that two others have become
  const KeyframeId id = add_keyframe(indexed, testkit::blank_frame(4, 9), tracked, first, 3);
  EXPECT_EQ(map[id].landmarks, (std::vector<LandmarkId>{{}, seen, {}, {}}));
  EXPECT_EQ(map[id].observed.frame, FrameId{9});
  EXPECT_EQ(map[id].world_from_camera.translation.x(), 2);
  EXPECT_EQ(map[id].parent, first);
  EXPECT_EQ(map[id].component, 3);
}

TEST(AddLandmarksByDepth, takes_features_with_depth_that_show_none) {
  Map map(testkit::kWorldRig, "ORB");
  ObservedFrame observed = testkit::blank_frame(3);
  observed.points_in_camera[1] = observed.points_in_camera[2] = {0, 0, 2};
  const KeyframeId id = map.add_keyframe(std::move(observed), testkit::aside(1), {}, 0);
  const LandmarkId before = map.add_landmark({0, 0, 0}, {id, 1});
  EXPECT_EQ(add_landmarks_by_depth(map, id), 1);
  EXPECT_FALSE(map[id].landmarks[0].valid());
  EXPECT_EQ(map[id].landmarks[1], before);
  EXPECT_EQ(map[map[id].landmarks[2]].point_in_world, Eigen::Vector3d(1, 0, 2));
}

/// Two keyframes that see nearly the same; the second knows every fifth of the first one's landmarks again
/// and has made landmarks of its own of the rest.
struct Twins {
  explicit Twins(const Rigid3& second_placed = testkit::aside(0.1), std::size_t known_again = 5) {
    (void)maker.add({});
    const KeyframeId second = maker.add(testkit::aside(0.1), second_placed);
    std::size_t n = 0;
    for (std::size_t i = 0; i < maker.map[second].landmarks.size(); ++i) {
      const LandmarkId shared = maker.map[second].landmarks[i];
      if (maker.map[shared].observations.size() < 2) continue;
      ++seen_by_both;
      if (n++ % known_again == 0) continue;
      maker.map.remove_observation(shared, second);
    }
    (void)add_landmarks_by_depth(maker.map, second);
    landmarks_before = maker.map.landmark_ids().size();
  }

  testkit::MapMaker maker{testkit::points_ahead(400, 3)};
  std::size_t seen_by_both = 0, landmarks_before = 0;
};

std::size_t shared_landmarks(const Map& map) {
  const auto ids = map.landmark_ids();
  return static_cast<std::size_t>(
      std::count_if(ids.begin(), ids.end(), [&](LandmarkId id) { return map[id].observations.size() > 1; }));
}

TEST(FuseWithNeighbours, makes_one_of_two_landmarks_at_one_point) {
  Twins twins;
  Map& map = twins.maker.map;
  const int joined = fuse_with_neighbours(map, {1}, {});
  EXPECT_GT(twins.seen_by_both, 100U);
  EXPECT_EQ(shared_landmarks(map), twins.seen_by_both);
  EXPECT_EQ(map.landmark_ids().size() + static_cast<std::size_t>(joined), twins.landmarks_before);
  for (std::size_t p = 0; p < twins.maker.known.size(); ++p) {
    const LandmarkId id = twins.maker.known[p].landmark;
    if (id.valid() && !map[id].erased()) {
      EXPECT_LT((map[id].point_in_world - twins.maker.world.points[p].position).norm(), 1e-9);
    }
  }
}

TEST(FuseWithNeighbours, adds_observations_where_a_feature_shows_nothing_yet) {
  Twins twins;
  Map& map = twins.maker.map;
  for (const LandmarkId id : std::vector<LandmarkId>(map[KeyframeId{1}].landmarks))
    if (map[id].observations.size() == 1) map.erase(id);
  const std::size_t before = map.landmark_ids().size();
  EXPECT_GT(fuse_with_neighbours(map, {1}, {}), 0);
  EXPECT_EQ(shared_landmarks(map), twins.seen_by_both);
  EXPECT_EQ(map.landmark_ids().size(), before);
}

TEST(FuseWithNeighbours, leaves_apart_what_lies_apart) {
  Twins twins(testkit::aside(0.3));
  EXPECT_EQ(fuse_with_neighbours(twins.maker.map, {1}, {}), 0);
  EXPECT_EQ(twins.maker.map.landmark_ids().size(), twins.landmarks_before);
}

/// All in the right direction, none at the depth that the other keyframe measured.
TEST(FuseWithNeighbours, leaves_apart_what_lies_behind) {
  Twins twins;
  Map& map = twins.maker.map;
  for (const LandmarkId id : map.landmark_ids()) map.move(id, 1.08 * map[id].point_in_world);
  EXPECT_EQ(fuse_with_neighbours(map, {1}, {}), 0);
}

TEST(FuseWithNeighbours, keyframes_without_shared_landmarks_are_no_neighbours) {
  Twins twins(testkit::aside(0.1), 1000);
  EXPECT_EQ(fuse_with_neighbours(twins.maker.map, {1}, {}), 0);
}

TEST(FuseNeighbourhoods, joins_keyframes_that_share_nothing_yet) {
  Twins twins(testkit::aside(0.1), 1000);
  EXPECT_GT(fuse_neighbourhoods(twins.maker.map, {0}, {1}, {}), 100);
  EXPECT_EQ(shared_landmarks(twins.maker.map), twins.seen_by_both);
}

TEST(CullLandmarks, erases_landmarks_that_were_not_seen_again) {
  Map map(testkit::kWorldRig, "ORB");
  for (std::int32_t k = 0; k < 2; ++k) (void)map.add_keyframe(testkit::blank_frame(3), {}, {k - 1}, 0);
  const KeyframeId first{0}, second{1};
  const LandmarkId lonely = map.add_landmark({0, 0, 0}, {first, 0}),
                   seen_again = map.add_landmark({0, 0, 0}, {first, 1});
  map.add_observation(seen_again, {second, 0});
  EXPECT_EQ(cull_landmarks(map), 1);
  EXPECT_TRUE(map[lonely].erased());
  EXPECT_EQ(map.landmark_ids(), (std::vector<LandmarkId>{seen_again}));
}

/// Five keyframes that all show the same 20 landmarks.
IndexedMap five_alike() {
  Map map(testkit::kWorldRig, "ORB");
  for (std::int32_t k = 0; k < 5; ++k) {
    ObservedFrame observed = testkit::blank_frame(20);
    for (Keypoint& keypoint : observed.features.keypoints) keypoint.sigma_px = k == 3 ? 1.0F : 1.44F;
    (void)map.add_keyframe(std::move(observed), {}, {k - 1}, 0);
    for (std::int32_t i = 0; i < 20; ++i)
      k == 0 ? (void)map.add_landmark({0, 0, 0}, {{0}, i}) : map.add_observation({i}, {{k}, i});
  }
  return IndexedMap(std::move(map));
}

/// Keyframe 3 shows everything at a finer scale, after keyframe 2 three are left, the first one stays.
TEST(CullKeyframes, erases_what_three_others_show_as_well) {
  IndexedMap indexed = five_alike();
  EXPECT_EQ(cull_keyframes(indexed, {4}, {}), (std::vector<KeyframeId>{{2}, {1}}));
  EXPECT_EQ(indexed.places().size(), 3U);
  EXPECT_EQ(indexed.map().keyframe_ids(), (std::vector<KeyframeId>{{0}, {3}, {4}}));
}

TEST(CullKeyframes, keeps_a_keyframe_that_shows_enough_of_its_own) {
  IndexedMap indexed = five_alike();
  for (std::int32_t i = 0; i < 3; ++i)
    for (const std::int32_t k : {0, 1, 3})
      indexed.edit().remove_observation({i}, {k});  // 15 % in one other only
  const auto erased = cull_keyframes(indexed, {4}, {});
  EXPECT_EQ(std::count(erased.begin(), erased.end(), KeyframeId{2}), 0);
}

}  // namespace
}  // namespace cairn
