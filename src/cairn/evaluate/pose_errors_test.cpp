// SPDX-License-Identifier: Apache-2.0
#include "cairn/evaluate/pose_errors.h"

#include <gtest/gtest.h>

#include <initializer_list>
#include <numbers>

#include "cairn/core/error.h"

namespace cairn {
namespace {

using Intervals = std::vector<std::pair<std::size_t, std::size_t>>;

/// Estimates along x at `places_m`, one each 100 ms; references at the origin.
std::vector<PosePair> along_x(std::initializer_list<double> places_m) {
  std::vector<PosePair> pairs;
  for (const double x : places_m) {
    const auto stamp = static_cast<std::int64_t>(pairs.size()) * 100'000'000;
    pairs.push_back({stamp, {Eigen::Quaterniond::Identity(), {x, 0, 0}}, {}});
  }
  return pairs;
}

Intervals intervals(const std::vector<PosePair>& pairs, double delta, RpeUnit unit, bool all_pairs) {
  return rpe_intervals(pairs, {delta, unit, all_pairs});
}

TEST(PoseErrors, WithinATolerance) {
  const PoseErrors errors{{0.01, 0.05, 0.2, 0.03}, {1, 5, 1, 6}};
  EXPECT_EQ(count_within(errors, {0.05, 5}), 2U);
  EXPECT_EQ(count_within(errors, {0.05, 10}), 3U);
  EXPECT_EQ(count_within(errors, {1, 1}), 2U);
  EXPECT_EQ(count_within({}, {1, 1}), 0U);
}

TEST(PoseErrors, IntervalsByFrames) {
  const auto six = along_x({0, 1, 2, 3, 4, 5});
  EXPECT_EQ(intervals(six, 2, RpeUnit::frames, false), (Intervals{{0, 2}, {2, 4}}));
  EXPECT_EQ(intervals(six, 3, RpeUnit::frames, true), (Intervals{{0, 3}, {1, 4}, {2, 5}}));
  EXPECT_EQ(intervals(six, 5, RpeUnit::frames, false), (Intervals{{0, 5}}));
  EXPECT_EQ(intervals(six, 6, RpeUnit::frames, false), Intervals{});
  EXPECT_EQ(intervals({}, 1, RpeUnit::frames, false), Intervals{});
}

TEST(PoseErrors, IntervalsByPath) {
  const auto pairs = along_x({0, 0.6, 1.2, 0.8, 0.8, 1.9, 2.0});  // steps 0.6 0.6 0.4 0 1.1 0.1
  EXPECT_EQ(intervals(pairs, 1, RpeUnit::metres, false), (Intervals{{2, 5}}));
  // 0: to 1.2, too far off; 1: to 1.0 twice, the first counts; 2: to 0.4; 3: to 1.1; 4: to 1.1; 5: to 0.1
  EXPECT_EQ(intervals(pairs, 1, RpeUnit::metres, true), (Intervals{{1, 3}, {3, 5}, {4, 5}}));
  EXPECT_EQ(intervals({}, 1, RpeUnit::metres, true), Intervals{});
}

TEST(PoseErrors, IntervalsByTime) {
  const auto six = along_x({0, 1, 2, 3, 4, 5});
  EXPECT_EQ(intervals(six, 0.2, RpeUnit::seconds, false), (Intervals{{0, 2}, {1, 3}, {2, 4}}));
  EXPECT_EQ(intervals(six, 0.24, RpeUnit::seconds, true), (Intervals{{0, 2}, {1, 3}, {2, 4}}));
  EXPECT_EQ(intervals(six, 10, RpeUnit::seconds, false), Intervals{});
}

TEST(PoseErrors, AbsoluteAreDistanceAndAngle) {
  const std::vector<PosePair> pairs{
      {0, {rotation_exp({0.3, 0, 0}), {3, 0, 4}}, {rotation_exp({0.1, 0, 0}), {}}}};
  const PoseErrors errors = absolute_errors(pairs);
  EXPECT_DOUBLE_EQ(errors.translation_m[0], 5.0);
  EXPECT_NEAR(errors.rotation_deg[0], 0.2 * 180 / std::numbers::pi, 1e-12);
}

TEST(PoseErrors, RelativeDoNotSeeARigidMotion) {
  const Rigid3 moved{rotation_exp({1, 2, 3}), {4, 5, 6}};
  std::vector<PosePair> pairs;
  for (int i = 0; i < 5; ++i) {
    const Rigid3 camera{rotation_exp({0.1 * i, 0.2, 0}), {0.5 * i, 1, 0}};
    pairs.push_back({i, moved * camera, camera});
  }
  const PoseErrors errors = relative_errors(pairs, Intervals{{0, 1}, {1, 4}});
  ASSERT_EQ(errors.translation_m.size(), 2U);
  EXPECT_LT(errors.translation_m[1], 1e-13);
  EXPECT_LT(errors.rotation_deg[1], 1e-6);
}

TEST(PoseErrors, CheckTheirOptions) {
  EXPECT_THROW((void)intervals({}, 0, RpeUnit::metres, false), PreconditionError);
  EXPECT_THROW((void)intervals({}, 1.5, RpeUnit::frames, false), PreconditionError);
}

}  // namespace
}  // namespace cairn
