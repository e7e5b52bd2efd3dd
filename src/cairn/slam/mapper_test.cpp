// SPDX-License-Identifier: Apache-2.0
#include "cairn/slam/mapper.h"

#include <gtest/gtest.h>

#include "cairn/core/executor.h"
#include "cairn/testing/geometry/camera_paths.h"
#include "cairn/testing/map/point_world.h"

namespace cairn {
namespace {

/// A mapper that is given views of points ahead.
struct Mapping {
  explicit Mapping(int threads = 1) : executor(threads) { world.noise_px = 0.3; }

  [[nodiscard]] ObservedFrame see(const Rigid3& truth) { return world.see(truth, frame++).observed; }

  std::optional<KeyframeId> begin(const Rigid3& truth) { return mapper.begin_component(see(truth)); }

  /// A keyframe that was tracked by what keyframe `parent` shows.
  KeyframeId add(const Rigid3& truth, const Rigid3& tracked_at, KeyframeId parent) {
    const ObservedFrame observed = see(truth);
    FramePose tracked;
    tracked.world_from_camera = tracked_at;
    const PosedFrame view{map.rig(), observed, tracked_at.inverse()};
    std::vector<LandmarkId> shown;
    for (const LandmarkId id : map[parent].landmarks)
      if (id.valid()) shown.push_back(id);
    tracked.landmarks.resize(observed.observations.size());
    for (const Correspondence& found : find_landmarks(map, shown, view, 10))
      tracked.landmarks[static_cast<std::size_t>(found.feature)] = found.landmark;
    const KeyframeId id = mapper.insert(observed, tracked, parent);
    mapper.start_adjustment(id);
    return id;
  }
  KeyframeId add(const Rigid3& truth, KeyframeId parent) { return add(truth, truth, parent); }

  testkit::PointWorld world = testkit::points_ahead(500, 13);
  std::int32_t frame = 0;
  SlamOptions options;
  Executor executor;
  IndexedMap indexed{Map(testkit::kWorldRig, "ORB")};
  Map& map = indexed.edit();
  const PlaceIndex& places = indexed.places();
  StageTimes times;
  Mapper mapper{options, executor, indexed, times};
};

TEST(Mapper, the_first_frame_with_depth_begins_the_map) {
  Mapping mapping;
  EXPECT_FALSE(mapping.mapper.begin_component(testkit::blank_frame(500)));
  const auto first = mapping.begin(testkit::aside(3));
  ASSERT_TRUE(first);
  EXPECT_EQ(mapping.map[*first].world_from_camera.translation.norm(), 0) << "the world is its camera";
  EXPECT_EQ(mapping.map.landmark_ids().size(), mapping.map[*first].observed.observations.size());
  EXPECT_TRUE(mapping.places.contains(first->value));
}

TEST(Mapper, another_component_begins_after_lost_frames_only) {
  Mapping mapping;
  mapping.options.lost_frames = 3;
  (void)mapping.begin({});
  EXPECT_FALSE(mapping.begin({}));
  EXPECT_FALSE(mapping.begin({}));
  const auto second = mapping.begin({});
  ASSERT_TRUE(second);
  EXPECT_EQ(mapping.map.component_of(*second), 1);
  EXPECT_FALSE(mapping.map[*second].parent.valid());
  EXPECT_FALSE(mapping.begin({})) << "counted anew";
}

TEST(Mapper, lost_frames_count_in_a_row) {
  Mapping mapping;
  mapping.options.lost_frames = 2;
  (void)mapping.begin({});
  EXPECT_FALSE(mapping.begin({}));
  mapping.mapper.found();
  EXPECT_FALSE(mapping.begin({}));
  EXPECT_TRUE(mapping.begin({}));
}

TEST(Mapper, the_world_stays_where_the_first_keyframe_was) {
  Mapping mapping;
  const KeyframeId first = *mapping.begin({});
  KeyframeId last = first;
  for (int k = 1; k < 4; ++k) {
    (void)mapping.mapper.apply_adjustment();
    last = mapping.add(testkit::aside(0.1 * k), testkit::aside(0.11 * k), last);
  }
  (void)mapping.mapper.apply_adjustment();
  mapping.map.move(first, testkit::aside(0.02));  // as a window may that holds others
  mapping.mapper.finish();
  EXPECT_LT(motion_norm(mapping.map[first].world_from_camera), 1e-9);
}

TEST(Mapper, a_keyframe_shares_landmarks_and_brings_its_own) {
  Mapping mapping;
  const auto first = mapping.begin({});
  const KeyframeId second = mapping.add(testkit::aside(0.4), *first);
  int shared = 0, own = 0;
  for (const LandmarkId id : mapping.map[second].landmarks) {
    ASSERT_TRUE(id.valid());
    (mapping.map[id].observations.size() > 1 ? shared : own) += 1;
  }
  EXPECT_GT(shared, 100);
  EXPECT_GT(own, 20);
  EXPECT_EQ(mapping.map[second].parent, *first);
  EXPECT_TRUE(mapping.places.contains(second.value));
}

TEST(Mapper, an_adjustment_is_taken_over_after_its_lag) {
  for (const int threads : {1, 3}) {
    Mapping mapping(threads);
    const auto first = mapping.begin({});
    EXPECT_FALSE(mapping.mapper.apply_adjustment_if_due()) << "none under way";
    const Rigid3 truth = testkit::aside(0.3), wrong{rotation_exp({0, 0.001, 0}), {0.304, 0, 0}};
    const KeyframeId second = mapping.add(truth, wrong, *first);
    for (int i = 0; i < mapping.options.mapping.window_lag; ++i) {
      EXPECT_FALSE(mapping.mapper.apply_adjustment_if_due());
      EXPECT_EQ(mapping.map[second].world_from_camera.translation, wrong.translation);
    }
    EXPECT_TRUE(mapping.mapper.apply_adjustment_if_due());
    EXPECT_LT(testkit::distance(mapping.map[second].world_from_camera, truth), 1.5e-3);
    EXPECT_FALSE(mapping.mapper.apply_adjustment()) << "once";
    EXPECT_EQ(mapping.times.window.size(), 1U);
  }
}

TEST(Mapper, redundant_keyframes_leave_the_places_too) {
  Mapping mapping;
  KeyframeId last = *mapping.begin({});
  for (int k = 1; k < 8; ++k) {
    (void)mapping.mapper.apply_adjustment();
    last = mapping.add(testkit::aside(0.01 * k), last);
  }
  const auto kept = mapping.map.keyframe_ids();
  EXPECT_LT(kept.size(), 8U);
  EXPECT_EQ(mapping.places.size(), kept.size());
  for (const KeyframeId id : kept) EXPECT_TRUE(mapping.places.contains(id.value));
}

TEST(Mapper, the_graphs_are_odometry_before_and_the_map_after) {
  Mapping mapping;
  const KeyframeId first = *mapping.begin({});
  const Rigid3 tracked_at{rotation_exp({0, 0.001, 0}), {0.304, 0, 0}};
  const KeyframeId second = mapping.add(testkit::aside(0.3), tracked_at, first);
  mapping.mapper.finish();
  PoseGraph before, after;
  const std::vector<PoseGraph::Edge> loops{{second.value, first.value, {}, Matrix6d::Identity(), false}};
  mapping.mapper.fill_graphs(loops, before, after);
  ASSERT_EQ(before.vertices.size(), 2U);
  ASSERT_EQ(after.edges.size(), 2U) << "odometry and the loop";
  EXPECT_EQ(after.edges[1].a, second.value);
  EXPECT_LT(motion_norm(before.vertices[1].world_from_vertex.inverse() * tracked_at), 1e-12);
  EXPECT_EQ(after.vertices[1].world_from_vertex.translation,
            mapping.map[second].world_from_camera.translation);
  EXPECT_LT(testkit::distance(after.vertices[1].world_from_vertex, testkit::aside(0.3)), 1.5e-3);
  EXPECT_EQ(before.fixed, (std::vector<std::int64_t>{first.value}));
}

TEST(Mapper, odometry_leaves_the_whole_unadjusted) {
  Mapping mapping;
  mapping.options.odometry = true;
  const KeyframeId first = *mapping.begin({});
  (void)mapping.add(testkit::aside(0.3), first);
  mapping.mapper.finish();
  EXPECT_TRUE(mapping.times.global.empty());
}

}  // namespace
}  // namespace cairn
