// SPDX-License-Identifier: Apache-2.0
#include "cairn/slam/frame_pose.h"

#include <gtest/gtest.h>

#include "cairn/testing/geometry/camera_paths.h"
#include "cairn/testing/slam/map_maker.h"

namespace cairn {
namespace {

constexpr int kMinInliers = 20;

/// A map of one keyframe in the origin, and a frame taken beside it.
struct Scene {
  explicit Scene(double noise_px = 0) : maker(make_world(noise_px)) {
    (void)maker.add({});
    seen = maker.world.see(truth, 1);
    for (std::size_t i = 0; i < seen.points.size(); ++i) {
      const LandmarkId id = maker.known[seen.points[i]].landmark;
      if (id.valid()) found.push_back({static_cast<std::int32_t>(i), id, maker.map[id].point_in_world});
    }
  }

  static testkit::PointWorld make_world(double noise_px) {
    testkit::PointWorld world = testkit::points_ahead(500, 2);
    world.noise_px = noise_px;
    return world;
  }

  [[nodiscard]] PosedFrame view_from(const Rigid3& world_from_camera) const {
    return {maker.map.rig(), seen.observed, world_from_camera.inverse()};
  }

  Rigid3 truth{rotation_exp({0.01, 0.04, 0}), {0.15, 0.02, -0.1}};
  testkit::MapMaker maker;
  testkit::View seen;
  std::vector<Correspondence> found;  // all of them right
};

double pose_error(const FramePose& tracked, const Scene& scene) {
  return motion_norm(tracked.world_from_camera.inverse() * scene.truth);
}

TEST(SolvePose, finds_the_pose_among_wrong_pairs) {
  Scene scene;
  const std::size_t wrong = scene.found.size() / 4;
  for (std::size_t i = 0; i + 1 < wrong; ++i) std::swap(scene.found[i].feature, scene.found[i + 1].feature);
  FramePose tracked;
  ASSERT_TRUE(solve_pose(scene.view_from({}), scene.found, kMinInliers, tracked));
  EXPECT_LT(pose_error(tracked, scene), 1e-4);
  EXPECT_EQ(tracked.matches, static_cast<int>(scene.found.size()));
  EXPECT_LE(tracked.inliers, tracked.matches - static_cast<int>(wrong) + 3);
  EXPECT_GE(tracked.inliers, tracked.matches - static_cast<int>(wrong));
}

TEST(SolvePose, keeps_the_landmarks_of_those_that_agree) {
  Scene scene;
  scene.found[5].point_in_world.x() += 0.3;
  FramePose tracked;
  ASSERT_TRUE(solve_pose(scene.view_from({}), scene.found, kMinInliers, tracked));
  EXPECT_EQ(tracked.landmarks.size(), scene.seen.points.size());
  for (std::size_t i = 0; i < scene.found.size(); ++i) {
    const Correspondence& one = scene.found[i];
    const LandmarkId shown = tracked.landmarks[static_cast<std::size_t>(one.feature)];
    EXPECT_EQ(shown, i == 5 ? LandmarkId{} : one.landmark);
  }
}

TEST(SolvePose, leaves_the_frame_alone_where_too_few_agree) {
  const Scene scene;
  FramePose tracked;
  tracked.world_from_camera = testkit::aside(3);
  tracked.inliers = 7;
  const std::span<const Correspondence> few(scene.found.data(), kMinInliers - 1);
  EXPECT_FALSE(solve_pose(scene.view_from({}), few, kMinInliers, tracked));
  EXPECT_FALSE(solve_pose(scene.view_from({}), {}, kMinInliers, tracked));
  EXPECT_EQ(tracked.world_from_camera.translation.x(), 3);
  EXPECT_EQ(tracked.inliers, 7);
  EXPECT_TRUE(tracked.landmarks.empty());
}

/// From a tenth of the landmarks and a pose that is a pixel off to all of them and a better one.
TEST(RefineInMap, finds_the_rest_of_the_landmarks) {
  const Scene scene(0.3);
  FramePose tracked;
  tracked.world_from_camera = perturb_left((Vector6d() << 0, 0.002, 0, 0, 0, 0).finished(), scene.truth);
  tracked.landmarks.resize(scene.seen.points.size());
  for (std::size_t i = 0; i < scene.found.size(); i += 10)
    tracked.landmarks[static_cast<std::size_t>(scene.found[i].feature)] = scene.found[i].landmark;
  ASSERT_TRUE(refine_in_map(scene.maker.map, scene.seen.observed, {}, tracked));
  EXPECT_GT(tracked.inliers, 9 * static_cast<int>(scene.found.size()) / 10);
  EXPECT_LT(pose_error(tracked, scene), 1e-3);
}

/// Two keyframes have each made its own landmarks of the same points.
TEST(RefineInMap, a_feature_with_a_landmark_gets_no_second_one) {
  testkit::MapMaker maker(testkit::points_ahead(500, 2), 0);
  for (int k = 0; k < 2; ++k) (void)maker.add({});
  const testkit::View seen = maker.world.see({}, 2);
  FramePose tracked;
  for (std::size_t i = 0; i < seen.points.size(); ++i) {
    const KeyframeId shown_by{static_cast<std::int32_t>(i % 2)};
    tracked.landmarks.push_back(maker.map[shown_by].landmarks[i]);
  }
  const std::vector<LandmarkId> before = tracked.landmarks;
  ASSERT_TRUE(refine_in_map(maker.map, seen.observed, {}, tracked));
  EXPECT_EQ(tracked.matches, static_cast<int>(seen.points.size()));
  EXPECT_EQ(tracked.landmarks, before);
}

TEST(RefineInMap, leaves_the_frame_alone_where_the_map_has_nothing) {
  const Scene scene;
  FramePose tracked;
  tracked.world_from_camera = scene.truth;
  tracked.landmarks.resize(scene.seen.points.size());
  EXPECT_FALSE(refine_in_map(scene.maker.map, scene.seen.observed, {}, tracked));
  EXPECT_EQ(tracked.inliers, 0);
}

}  // namespace
}  // namespace cairn
