// SPDX-License-Identifier: Apache-2.0
#include "cairn/slam/landmark_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cairn/testing/geometry/camera_paths.h"
#include "cairn/testing/slam/map_maker.h"

namespace cairn {
namespace {

constexpr double kRadius = 4;

/// A point two metres ahead; what is predicted for it when it was seen from `centre`, 10 px large.
std::optional<SearchWindow> predict_from(const Eigen::Vector3d& centre, float sigma_px = 1) {
  const ObservedFrame observed;
  const PosedFrame view{testkit::kWorldRig, observed, {}};
  Appearance appearance;
  appearance.keypoint.size = 10;
  appearance.keypoint.sigma_px = sigma_px;
  appearance.centre_in_world = centre;
  return predict_window(view, {0, 0, 2}, appearance, kRadius);
}

/// Seen from two metres away, `degrees` aside.
Eigen::Vector3d seen_aside(double degrees) {
  const double angle = degrees * std::numbers::pi / 180;
  return {2 * std::sin(angle), 0, 2 - 2 * std::cos(angle)};
}

TEST(PredictPlace, is_where_the_point_projects_to) {
  const auto place = predict_from({0, 0, 0});
  ASSERT_TRUE(place);
  EXPECT_DOUBLE_EQ(place->u, testkit::kWorldRig.cx);
  EXPECT_DOUBLE_EQ(place->v, testkit::kWorldRig.cy);
  EXPECT_DOUBLE_EQ(place->radius_px, kRadius);
  EXPECT_LT(place->min_size, 10);
  EXPECT_GT(place->max_size, 10);
}

TEST(PredictPlace, is_nowhere_behind_the_camera) {
  const ObservedFrame observed;
  const PosedFrame view{testkit::kWorldRig, observed, {}};
  Appearance appearance;
  appearance.centre_in_world = {0, 0, 2};  // looking back
  EXPECT_FALSE(predict_window(view, {0, 0, -1}, appearance, kRadius));
  EXPECT_FALSE(predict_window(view, {0, 0, 0}, appearance, kRadius));
}

TEST(PredictPlace, is_nowhere_for_a_look_from_far_aside) {
  EXPECT_TRUE(predict_from(seen_aside(59)));
  EXPECT_FALSE(predict_from(seen_aside(61)));
  EXPECT_FALSE(predict_from(seen_aside(180)));
}

TEST(PredictPlace, is_nowhere_at_another_distance_by_far) {
  EXPECT_TRUE(predict_from({0, 0, 2 - 2 * 4.9}));
  EXPECT_FALSE(predict_from({0, 0, 2 - 2 * 5.1}));
  EXPECT_TRUE(predict_from({0, 0, 2 - 2 / 4.9}));
  EXPECT_FALSE(predict_from({0, 0, 2 - 2 / 5.1}));
}

TEST(PredictPlace, grows_when_the_point_is_nearer) {
  const auto same = predict_from({0, 0, 0}), nearer = predict_from({0, 0, -2}),
             farther = predict_from({0, 0, 1});
  ASSERT_TRUE(same && nearer && farther);
  EXPECT_DOUBLE_EQ(nearer->min_size, 2 * same->min_size);
  EXPECT_DOUBLE_EQ(nearer->max_size, 2 * same->max_size);
  EXPECT_DOUBLE_EQ(farther->max_size, same->max_size / 2);
  EXPECT_DOUBLE_EQ(nearer->radius_px, 2 * kRadius);
  EXPECT_DOUBLE_EQ(farther->radius_px, kRadius) << "no level is below the lowest";
  EXPECT_DOUBLE_EQ(predict_from({0, 0, 1}, 6)->radius_px, 3 * kRadius);
}

/// Keyframes 0 and 1, half a metre apart, with all that they see as landmarks.
testkit::MapMaker two_keyframes() {
  testkit::MapMaker maker(testkit::points_ahead(400, 1));
  (void)maker.add(testkit::aside(0));
  (void)maker.add(testkit::aside(0.5));
  return maker;
}

TEST(LandmarkSearch, the_look_is_that_of_the_nearest_keyframe) {
  const testkit::MapMaker maker = two_keyframes();
  const Map& map = maker.map;
  int count = 0;
  for (const LandmarkId id : map.landmark_ids()) {
    if (map[id].observations.size() < 2) continue;
    ++count;
    const Appearance look = nearest_appearance(map, map[id], {0.4, 0, 0});
    EXPECT_EQ(look.descriptors, &map[KeyframeId{1}].observed.features.descriptors);
    EXPECT_EQ(map[KeyframeId{1}].landmarks[look.row], id);
    EXPECT_EQ(look.centre_in_world.x(), 0.5);
    EXPECT_EQ(nearest_appearance(map, map[id], {0, 0, 0}).centre_in_world.x(), 0);
  }
  EXPECT_GT(count, 10);
}

struct Search {
  testkit::MapMaker maker = two_keyframes();
  testkit::View seen = maker.world.see(testkit::aside(0.25), 2);

  [[nodiscard]] LandmarkId landmark_at(std::int32_t feature) const {
    return maker.known[seen.points[static_cast<std::size_t>(feature)]].landmark;
  }
  /// All landmarks, from a pose that is `aside_m` wrong.
  [[nodiscard]] std::vector<Correspondence> find(std::span<const LandmarkId> occupied = {},
                                                 double aside_m = 0) const {
    const PosedFrame frame{maker.map.rig(), seen.observed, testkit::aside(0.25 + aside_m).inverse()};
    return find_landmarks(maker.map, maker.map.landmark_ids(), frame, kRadius, occupied);
  }
};

TEST(LandmarkSearch, finds_what_a_frame_shows) {
  const Search search;
  const auto found = search.find();
  EXPECT_GT(found.size(), 150U);
  EXPECT_GE(found.size() + 5, search.seen.points.size());
  for (const Correspondence& one : found) {
    EXPECT_EQ(one.landmark, search.landmark_at(one.feature));
    EXPECT_EQ(one.point_in_world, search.maker.map[one.landmark].point_in_world);
  }
}

TEST(LandmarkSearch, leaves_features_with_a_landmark_out) {
  const Search search;
  std::vector<LandmarkId> occupied(search.seen.points.size());
  for (std::size_t i = 0; i < occupied.size(); i += 2) occupied[i] = {0};
  const auto found = search.find(occupied);
  EXPECT_GT(found.size(), 70U);
  for (const Correspondence& one : found) EXPECT_EQ(one.feature % 2, 1);
}

TEST(LandmarkSearch, finds_nothing_where_it_is_not_seen) {
  EXPECT_TRUE(Search().find({}, 1.0).empty());  // 50 px aside at 10 m
}

TEST(LandmarkSearch, finds_nothing_that_looks_different) {
  Search search;
  for (testkit::WorldPoint& point : search.maker.world.points) point.look += 1000;
  search.seen = search.maker.world.see(testkit::aside(0.25), 2);
  EXPECT_TRUE(search.find().empty());
}

TEST(LandmarkSearch, without_landmarks_there_is_nothing_to_find) {
  const Search search;
  const PosedFrame frame{search.maker.map.rig(), search.seen.observed, testkit::aside(0.25).inverse()};
  EXPECT_TRUE(find_landmarks(search.maker.map, {}, frame, kRadius).empty());
}

/// Two points at nearly one pixel that look alike: the window of one may be widened, and a feature goes to
/// one of them.
TEST(GuidedSearch, keeps_the_numbers_and_widens_single_windows) {
  const Search search;
  const Map& map = search.maker.map;
  const PosedFrame frame{map.rig(), search.seen.observed, testkit::aside(0.30).inverse()};
  const auto ids = map.landmark_ids();
  const auto count = [&](double extra_px) {
    GuidedSearch guided(frame, 1);
    for (std::size_t i = 0; i < ids.size(); ++i)
      guided.add(7 + i, map[ids[i]].point_in_world, nearest_appearance(map, map[ids[i]], {0, 0, 0}),
                 extra_px);
    const auto matches = guided.match();
    for (const GuidedMatch& match : matches)
      EXPECT_EQ(ids[match.point - 7], search.landmark_at(match.feature));
    return matches.size();
  };
  EXPECT_GT(count(20), count(0) + 50);
}

}  // namespace
}  // namespace cairn
