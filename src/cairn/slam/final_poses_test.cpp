// SPDX-License-Identifier: Apache-2.0
#include "cairn/slam/final_poses.h"

#include <gtest/gtest.h>

#include "cairn/core/executor.h"
#include "cairn/testing/geometry/camera_paths.h"
#include "cairn/testing/slam/map_maker.h"

namespace cairn {
namespace {

/// A keyframe in the origin, and frames beside it whose poses are two centimetres wrong: frame k is at k + 1
/// centimetres.
struct TrackedRun {
  explicit TrackedRun(int count = 5) {
    (void)maker.add({});
    for (int k = 0; k < count; ++k) remember(k);
  }

  static Rigid3 truth(int k) { return testkit::aside(0.01 * (k + 1)); }

  void remember(int k) {
    const testkit::View view = maker.world.see(truth(k), k + 1);
    FramePose tracked;
    for (const std::size_t point : view.points) tracked.landmarks.push_back(maker.known[point].landmark);
    TrackingResult track;
    track.frame = view.observed.frame;
    track.reference = KeyframeId{0};
    track.reference_from_frame = Rigid3{Eigen::Quaterniond::Identity(), {0, 0.02, 0}} * truth(k);
    memory.remember(frames.size(), view.observed, tracked);
    frames.push_back(track);
  }

  [[nodiscard]] double error(int k) const {
    const TrackingResult& track = frames[static_cast<std::size_t>(k)];
    const Rigid3 pose = maker.map.world_from_camera(*track.reference) * track.reference_from_frame;
    return motion_norm(pose.inverse() * truth(k));
  }

  testkit::MapMaker maker{testkit::points_ahead(400, 5)};
  FrameMemory memory;
  std::vector<TrackingResult> frames;
};

TEST(FinalPoses, are_solved_for_in_the_final_map) {
  for (const int threads : {1, 3}) {
    TrackedRun run;
    run.memory.refine(run.maker.map, {}, Executor(threads), run.frames);
    for (int k = 0; k < 5; ++k) EXPECT_LT(run.error(k), 1e-5) << k;  // pixels are kept as float
  }
}

TEST(FinalPoses, follow_a_map_that_has_moved) {
  TrackedRun run;
  const Rigid3 moved{rotation_exp({0, 0.5, 0}), {1, 2, 3}};
  Map& map = run.maker.map;
  map.move(KeyframeId{0}, moved);
  for (const LandmarkId id : map.landmark_ids()) map.move(id, moved * map[id].point_in_world);
  run.memory.refine(map, {}, Executor(2), run.frames);
  const Rigid3 pose = map.world_from_camera({0}) * run.frames[2].reference_from_frame;
  EXPECT_LT(motion_norm(pose.inverse() * moved * TrackedRun::truth(2)), 1e-5);
}

TEST(FinalPoses, of_keyframes_stay) {
  TrackedRun run;
  run.frames[3].frame = run.maker.map[KeyframeId{0}].observed.frame;
  run.memory.refine(run.maker.map, {}, Executor(), run.frames);
  EXPECT_NEAR(run.error(3), 0.02, 1e-9);
  EXPECT_LT(run.error(2), 1e-5);
}

TEST(FinalPoses, stay_where_too_few_landmarks_are_left) {
  TrackedRun run;
  Map& map = run.maker.map;
  const auto ids = map.landmark_ids();
  for (std::size_t i = 19; i < ids.size(); ++i) map.erase(ids[i]);
  run.memory.refine(map, {}, Executor(), run.frames);
  for (int k = 0; k < 5; ++k) EXPECT_NEAR(run.error(k), 0.02, 1e-9);
}

TEST(FinalPoses, stay_where_fewer_than_half_of_the_landmarks_agree) {
  TrackedRun run;
  Map& map = run.maker.map;
  const auto ids = map.landmark_ids();
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const double away = i % 2 == 0 ? 1 : -1;
    if (i % 5 < 3) map.move(ids[i], map[ids[i]].point_in_world + away * Eigen::Vector3d(1, 0.5, 0));
  }
  run.memory.refine(map, {}, Executor(), run.frames);
  for (int k = 0; k < 5; ++k) EXPECT_NEAR(run.error(k), 0.02, 1e-9);
}

TEST(FinalPoses, are_solved_for_although_most_landmarks_were_culled) {
  TrackedRun run;
  Map& map = run.maker.map;
  const auto ids = map.landmark_ids();
  for (TrackingResult& track : run.frames) track.inliers = static_cast<int>(ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i)
    if (i % 4 != 0) map.erase(ids[i]);
  run.memory.refine(map, {}, Executor(), run.frames);
  for (int k = 0; k < 5; ++k) EXPECT_LT(run.error(k), 1e-5) << k;
}

}  // namespace
}  // namespace cairn
