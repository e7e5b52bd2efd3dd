// SPDX-License-Identifier: Apache-2.0
#include "cairn/slam/local_map.h"

#include <gtest/gtest.h>

#include "cairn/testing/map/point_world.h"

namespace cairn {
namespace {

/// Five keyframes in a row; keyframe k shows landmarks 10 k to 10 k + 29, so neighbours share 20, the
/// next 10.
Map chain() {
  Map map(testkit::kWorldRig, "ORB");
  std::vector<LandmarkId> landmarks(70);
  for (std::int32_t k = 0; k < 5; ++k) {
    const KeyframeId id = map.add_keyframe(testkit::blank_frame(30), {}, {k - 1}, 0);
    for (std::int32_t i = 0; i < 30; ++i) {
      LandmarkId& landmark = landmarks[static_cast<std::size_t>(k) * 10 + static_cast<std::size_t>(i)];
      if (landmark.valid()) {
        map.add_observation(landmark, {id, i});
      } else {
        landmark = map.add_landmark({0, 0, 0}, {id, i});
      }
    }
  }
  return map;
}

std::vector<std::pair<std::int32_t, int>> plain(const std::vector<CovisibleKeyframe>& views) {
  std::vector<std::pair<std::int32_t, int>> pairs;
  for (const CovisibleKeyframe& view : views) pairs.emplace_back(view.keyframe.value, view.shared);
  return pairs;
}

using Views = std::vector<std::pair<std::int32_t, int>>;

TEST(LocalMap, keyframes_come_with_most_shared_first_then_the_later) {
  const Map map = chain();
  EXPECT_EQ(plain(keyframes_showing(map, map[KeyframeId{2}].landmarks)),
            (Views{{2, 30}, {3, 20}, {1, 20}, {4, 10}, {0, 10}}));
}

TEST(LocalMap, invalid_and_erased_landmarks_are_passed_over) {
  Map map = chain();
  const std::vector<LandmarkId> asked = {{}, {0}, {1}};
  map.erase(LandmarkId{1});
  EXPECT_EQ(plain(keyframes_showing(map, asked)), (Views{{0, 1}}));
}

TEST(LocalMap, covisible_keyframes_share_enough_and_are_others) {
  const Map map = chain();
  EXPECT_EQ(plain(covisible_keyframes(map, {1}, 20)), (Views{{2, 20}, {0, 20}}));
  EXPECT_EQ(plain(covisible_keyframes(map, {1}, 21)), Views{});
}

TEST(LocalMap, landmarks_of_keyframes_come_once_each) {
  const Map map = chain();
  const std::vector<KeyframeId> keyframes = {{1}, {0}};
  const auto landmarks = landmarks_of(map, keyframes, 100);
  ASSERT_EQ(landmarks.size(), 40U);
  for (std::int32_t i = 0; i < 40; ++i) EXPECT_EQ(landmarks[static_cast<std::size_t>(i)], LandmarkId{i});
}

TEST(LocalMap, a_landmark_is_given_up_when_it_is_not_seen_again_in_time) {
  Map map(testkit::kWorldRig, "ORB");
  for (std::int32_t k = 0; k < 5; ++k) (void)map.add_keyframe(testkit::blank_frame(3), {}, {k - 1}, 0);
  const LandmarkId lonely = map.add_landmark({0, 0, 0}, {KeyframeId{1}, 0}),
                   seen_again = map.add_landmark({0, 0, 0}, {KeyframeId{0}, 1});
  map.add_observation(seen_again, {KeyframeId{1}, 1});
  EXPECT_TRUE(is_on_trial_or_confirmed(map, lonely, 3));
  EXPECT_FALSE(is_on_trial_or_confirmed(map, lonely, 2));
  EXPECT_TRUE(is_on_trial_or_confirmed(map, seen_again, 0));
  EXPECT_EQ(landmarks_of(map, std::vector<KeyframeId>{{1}}, 2), (std::vector<LandmarkId>{seen_again}));
}

TEST(LocalMap, a_neighbourhood_is_the_best_keyframes_and_theirs) {
  const Map map = chain();
  const auto& seen = map[KeyframeId{0}].landmarks;
  EXPECT_EQ(local_keyframes(map, seen, 1, 0), (std::vector<KeyframeId>{{0}}));
  EXPECT_EQ(local_keyframes(map, seen, 1, 5), (std::vector<KeyframeId>{{0}, {1}}));
  EXPECT_EQ(local_keyframes(map, seen, 2, 1), (std::vector<KeyframeId>{{0}, {1}, {2}}));
}

}  // namespace
}  // namespace cairn
