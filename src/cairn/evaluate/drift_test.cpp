// SPDX-License-Identifier: Apache-2.0
#include "cairn/evaluate/drift.h"

#include <gtest/gtest.h>

#include <iterator>
#include <numbers>

#include "cairn/core/error.h"
#include "cairn/testing/geometry/reference_drive.h"

namespace cairn {
namespace {

using testkit::estimated_drive;
using testkit::true_drive;

/// Truth along x, one metre a frame; the estimate is `scale` times as long and turns `turn_rad` a frame.
std::vector<PosePair> straight(int count, double scale, double turn_rad) {
  std::vector<PosePair> pairs;
  for (int i = 0; i < count; ++i)
    pairs.push_back({i,
                     {rotation_exp({turn_rad * i, 0, 0}), {scale * i, 0, 0}},
                     {Eigen::Quaterniond::Identity(), {1.0 * i, 0, 0}}});
  return pairs;
}

/// Printed by evaluation_reference.py.
const DriftFigures kByLength[] = {
    {100, 38, 2.46361962432855, 0.0025684913299249},  {200, 35, 2.54314873365792, 0.00198185720591745},
    {300, 31, 2.6393116869338, 0.00196607258909851},  {400, 28, 2.78474329450433, 0.0019287772648046},
    {500, 25, 2.95428869621453, 0.00193976084242917}, {600, 22, 3.11843394629345, 0.00191422896691836},
    {700, 18, 3.21881901808549, 0.0018931844775605},  {800, 15, 3.35574121181359, 0.00189218130096331}};
const DriftFigures kAll{0, 212, 2.79790967297237, 0.00205183389086939};

void expect_near(const DriftFigures& found, const DriftFigures& expected) {
  EXPECT_EQ(found.length_m, expected.length_m);
  EXPECT_EQ(found.segments, expected.segments);
  EXPECT_NEAR(found.translation_percent, expected.translation_percent, 1e-10);
  EXPECT_NEAR(found.rotation_deg_per_m, expected.rotation_deg_per_m, 1e-12);
}

TEST(Drift, EqualsTheReferenceImplementation) {
  std::vector<PosePair> pairs;
  for (int i = 0; i < 400; ++i) pairs.push_back({i, estimated_drive(i), true_drive(i)});
  const std::optional<Drift> found = measure_drift(pairs);
  ASSERT_TRUE(found);
  ASSERT_EQ(found->by_length.size(), std::size(kByLength));
  for (std::size_t k = 0; k < found->by_length.size(); ++k) expect_near(found->by_length[k], kByLength[k]);
  expect_near(found->all, kAll);
}

TEST(Drift, ReadsOffScaleAndTurn) {
  const std::optional<Drift> found = measure_drift(straight(901, 1.02, 1e-4));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->by_length.size(), 8U);
  // the first frame with more than 100 m behind it is the 101st: 2.02 m too far, 101 turns
  EXPECT_NEAR(found->by_length[0].translation_percent, 2.02, 1e-9);
  EXPECT_NEAR(found->by_length[0].rotation_deg_per_m, 1.01 * 180 / std::numbers::pi * 1e-4, 1e-12);
  EXPECT_EQ(found->by_length[0].segments, 80U);
}

TEST(Drift, IsNothingForShortPaths) {
  EXPECT_FALSE(measure_drift({}));
  EXPECT_FALSE(measure_drift(straight(101, 1.1, 0)));  // exactly 100 m, and more is asked for
  EXPECT_TRUE(measure_drift(straight(102, 1.1, 0)));
  EXPECT_TRUE(measure_drift(straight(20, 1.1, 0), {{5, 10}, 1}));
}

TEST(Drift, ChecksItsOptions) {
  EXPECT_THROW((void)measure_drift({}, {{100}, 0}), PreconditionError);
  EXPECT_THROW((void)measure_drift({}, {{0}, 10}), PreconditionError);
}

}  // namespace
}  // namespace cairn
