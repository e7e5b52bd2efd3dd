// SPDX-License-Identifier: Apache-2.0
#include "cairn/slam/loop_closer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "cairn/core/executor.h"
#include "cairn/core/random.h"
#include "cairn/testing/geometry/camera_paths.h"
#include "cairn/testing/slam/map_maker.h"

namespace cairn {
namespace {

constexpr int kTurn = 40;      // keyframes of a full circle
constexpr double kRadius = 3;  // metres
constexpr int kMemory = 2;     // keyframes, after which tracking has forgotten a point
constexpr double kMillimetre = 1e-3;

/// Keyframe k of a walk on a circle, looking outwards.
Rigid3 on_circle(double k) {
  const Rigid3 turn{rotation_exp({0, 2 * std::numbers::pi * k / kTurn, 0}), {0, 0, 0}};
  return turn * Rigid3{Eigen::Quaterniond::Identity(), {0, 0, kRadius}};
}

/// A round room.
testkit::PointWorld round_room() {
  testkit::PointWorld world;
  Random random(11);
  for (int i = 0; i < 3500; ++i) {
    const double angle = random.uniform(0, 2 * std::numbers::pi), radius = random.uniform(5, 6.5);
    world.add({radius * std::sin(angle), random.uniform(-1, 1), radius * std::cos(angle)});
  }
  return world;
}

/// A walk whose odometry drifts, keyframe by keyframe handed to a loop closer.
class Walk {
 public:
  explicit Walk(testkit::PointWorld world, const Rigid3& drift = {}, int threads = 1)
      : drift_(drift),
        executor_(threads),
        maker_(std::move(world), kMemory),
        closer_(options_, executor_, maker_.indexed) {}

  /// Returns whether the map was bent.
  bool step_to(const Rigid3& truth) {
    const Rigid3 step = truths_.empty() ? truth : drift_ * truths_.back().inverse() * truth;
    const Rigid3 placed = truths_.empty() ? step : pose(truths_.size() - 1) * step;
    odometry_.push_back(odometry_.empty() ? step : odometry_.back() * step);
    truths_.push_back(truth);
    const KeyframeId id = maker_.add(truth, placed);
    return closer_.close(id);
  }

  /// Keyframes 0 to count - 1 of the circle. Returns whether the map was bent.
  bool go_round(int count) {
    bool bent = false;
    for (auto k = static_cast<int>(truths_.size()); k < count; ++k) bent = step_to(on_circle(k)) || bent;
    return bent;
  }

  [[nodiscard]] const Map& map() const { return maker_.map; }
  [[nodiscard]] const LoopReport& report() const { return closer_.report(); }
  [[nodiscard]] const LoopCloser& closer() const { return closer_; }
  [[nodiscard]] std::size_t size() const { return truths_.size(); }
  [[nodiscard]] Rigid3 pose(std::size_t k) const {
    return map().world_from_camera({static_cast<std::int32_t>(k)});
  }
  [[nodiscard]] double error(std::size_t k) const { return testkit::distance(pose(k), truths_[k]); }
  [[nodiscard]] double odometry_error(std::size_t k) const {
    return testkit::distance(odometry_[k], truths_[k]);
  }

  /// The largest distance of a keyframe from where odometry put it, metres.
  [[nodiscard]] double largest_move() const {
    double largest = 0;
    for (std::size_t k = 0; k < odometry_.size(); ++k)
      largest = std::max(largest, testkit::distance(pose(k), odometry_[k]));
    return largest;
  }

 private:
  Rigid3 drift_;
  SlamOptions options_;
  Executor executor_;
  testkit::MapMaker maker_;
  LoopCloser closer_;
  std::vector<Rigid3> truths_, odometry_;
};

/// After a turn some 20 cm away, and 4 degrees turned.
Rigid3 drift_of_a_step() {
  return {rotation_exp({0, 0.0015, 0}), {0, 0.004, 0}};
}

TEST(LoopCloser, closes_a_loop_after_drift) {
  Walk walk(round_room(), drift_of_a_step());
  EXPECT_FALSE(walk.go_round(kTurn - 5));
  EXPECT_TRUE(walk.go_round(kTurn + 4));
  EXPECT_GE(walk.report().closed, 1);
  EXPECT_EQ(walk.closer().edges().size(), static_cast<std::size_t>(walk.report().closed));
  const std::size_t back = kTurn + 3;
  EXPECT_GT(walk.odometry_error(back), 0.15);
  EXPECT_LT(walk.error(back), 0.03);
  EXPECT_LT(walk.error(kTurn / 2), walk.odometry_error(back) / 2);
}

TEST(LoopCloser, joins_the_landmarks_of_a_closed_loop) {
  Walk walk(round_room(), drift_of_a_step());
  (void)walk.go_round(kTurn + 4);
  int joined = 0;
  for (const LandmarkId id : walk.map().landmark_ids()) {
    const auto& observations = walk.map()[id].observations;
    joined += observations.front().keyframe.value < 5 && observations.back().keyframe.value >= kTurn ? 1 : 0;
  }
  EXPECT_GT(joined, 50);
}

TEST(LoopCloser, a_loop_without_drift_joins_landmarks_and_bends_nothing) {
  Walk walk(round_room());
  EXPECT_FALSE(walk.go_round(kTurn + 4));
  EXPECT_EQ(walk.report().closed, 0);
  EXPECT_GE(walk.report().joined, 1);
  EXPECT_LT(walk.largest_move(), kMillimetre);
}

TEST(LoopCloser, is_the_same_at_any_number_of_threads) {
  Walk one(round_room(), drift_of_a_step(), 1), many(round_room(), drift_of_a_step(), 3);
  EXPECT_TRUE(one.go_round(kTurn + 3));
  EXPECT_TRUE(many.go_round(kTurn + 3));
  for (std::size_t k = 0; k < one.size(); ++k)
    EXPECT_EQ(one.pose(k).translation, many.pose(k).translation) << k;
}

/// Keyframe `there` and those around it see what keyframe `here` and those around it see, from the same side
/// and distance: nothing in the images tells the two places apart.
testkit::PointWorld with_repetition(double here, double there) {
  constexpr double kHalfWidth = 2;  // metres: as much as a keyframe sees
  testkit::PointWorld world = round_room();
  const auto is_before = [&](double k, const Eigen::Vector3d& point) {
    const Eigen::Vector3d in_camera = on_circle(k).inverse() * point;
    return in_camera.z() > 0 && std::abs(in_camera.x()) < kHalfWidth;
  };
  std::erase_if(world.points,
                [&](const testkit::WorldPoint& point) { return is_before(there, point.position); });
  const Rigid3 there_from_here = on_circle(there) * on_circle(here).inverse();
  for (const testkit::WorldPoint& point : std::vector<testkit::WorldPoint>(world.points))
    if (is_before(here, point.position))
      world.points.push_back({there_from_here * point.position, point.look});
  return world;
}

/// A place across the room that looks like another one to the last point: several keyframes agree, and err.
TEST(WrongLoops, a_place_that_repeats_itself_across_the_room_bends_nothing) {
  Walk walk(with_repetition(3, 25), drift_of_a_step());
  EXPECT_FALSE(walk.go_round(30));
  EXPECT_GE(walk.report().verified, 3) << "else nothing was shown";
  EXPECT_GE(walk.report().rejected, 3);
  EXPECT_LT(walk.largest_move(), kMillimetre);
}

/// From keyframe kBack - 3 on the round room looks like another. In it, keyframes kBack and kBack + 1 see
/// what keyframes 0 and 1 saw, these many metres aside.
constexpr int kBack = kTurn;

testkit::PointWorld with_things_moved(const std::vector<double>& asides) {
  constexpr std::uint64_t kOtherLooks = 100000;
  testkit::PointWorld world = round_room();
  const std::vector<testkit::WorldPoint> room = world.points;
  for (testkit::WorldPoint& point : world.points) point.last_frame = kBack - 4;
  for (const testkit::WorldPoint& point : room)
    world.points.push_back({point.position, point.look + kOtherLooks, kBack - 3});
  for (std::size_t k = 0; k < asides.size(); ++k) {
    const Rigid3 camera = on_circle(static_cast<double>(k));
    const Rigid3 moved = camera * testkit::aside(asides[k]) * camera.inverse();
    const std::int32_t frame = kBack + static_cast<std::int32_t>(k);
    for (const testkit::WorldPoint& point : room)
      world.points.push_back({moved * point.position, point.look, frame, frame});
  }
  return world;
}

TEST(WrongLoops, one_keyframe_alone_bends_nothing) {
  Walk walk(with_things_moved({0.3}));
  EXPECT_FALSE(walk.go_round(kBack + 4));
  EXPECT_GE(walk.report().verified, 1) << "else nothing was shown";
  EXPECT_GE(walk.report().unconfirmed, 1);
  EXPECT_LT(walk.largest_move(), kMillimetre);
}

TEST(WrongLoops, two_keyframes_that_contradict_bend_nothing) {
  Walk walk(with_things_moved({0.3, -0.3}));
  EXPECT_FALSE(walk.go_round(kBack + 4));
  EXPECT_GE(walk.report().verified, 2) << "else nothing was shown";
  EXPECT_GE(walk.report().unconfirmed, 2);
  EXPECT_LT(walk.largest_move(), kMillimetre);
}

/// Four metres along a wall and back. On the way back all looks different, but from the last two keyframes
/// the wall as it was, moved by 1.2 m: less than odometry may drift, more than ten steps of it can give way.
TEST(WrongLoops, what_strains_the_graph_bends_nothing) {
  constexpr std::uint64_t kOtherLooks = 100000;
  testkit::PointWorld world;
  Random random(14);
  for (int i = 0; i < 1500; ++i)
    world.add({random.uniform(-3, 8), random.uniform(-2, 2), random.uniform(2, 5)});
  const std::vector<testkit::WorldPoint> wall = world.points;
  for (testkit::WorldPoint& point : world.points) point.last_frame = 6;
  for (const testkit::WorldPoint& point : wall) {
    world.points.push_back({point.position, point.look + kOtherLooks, 7});
    world.points.push_back({testkit::aside(1.2) * point.position, point.look, 10});
  }
  Walk walk(world);
  for (const double x : {0.0, 0.8, 1.6, 2.4, 3.2, 4.0, 3.2, 2.4, 1.6, 0.8, 0.0, 0.1})
    EXPECT_FALSE(walk.step_to(testkit::aside(x)));
  EXPECT_GE(walk.report().verified, 2) << "else nothing was shown";
  EXPECT_GE(walk.report().rejected, 1);
  EXPECT_TRUE(walk.closer().edges().empty());
  EXPECT_LT(walk.largest_move(), kMillimetre);
}

/// So the tests before can fail. What cannot be told from a loop is one.
TEST(WrongLoops, two_keyframes_that_agree_are_believed) {
  Walk walk(with_things_moved({0.3, 0.3}));
  EXPECT_TRUE(walk.go_round(kBack + 4));
  EXPECT_NEAR(testkit::distance(walk.pose(kBack + 1), on_circle(kBack + 1)), 0.3, 0.1);
}

}  // namespace
}  // namespace cairn
