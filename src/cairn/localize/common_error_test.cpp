// SPDX-License-Identifier: Apache-2.0
#include "cairn/localize/common_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "cairn/core/random.h"
#include "cairn/geometry/rigid3.h"

namespace cairn {
namespace {

/// Frames 2, 7, 12, ... with errors of that deviation, `factor` times as large from frame `from` on.
std::vector<HeldOutFrame> frames_with(double sigma, int count, double factor = 1, int from = 0) {
  Random random(4);
  std::vector<HeldOutFrame> frames;
  for (int k = 0; k < count; ++k) {
    HeldOutFrame frame;
    frame.keyframe = {5 * k + 2};
    const double size = frame.keyframe.value >= from ? sigma * factor : sigma;
    for (Eigen::Index i = 0; i < 6; ++i) frame.to_map[i] = size * random.normal();
    frame.to_given = 2 * frame.to_map;
    frame.formal.setConstant(0.25 * sigma * sigma);
    frames.push_back(frame);
  }
  return frames;
}

TEST(CommonErrors, are_what_noise_does_not_explain) {
  const CommonErrors errors(frames_with(0.1, 400));
  const auto error = errors.near({1000});
  ASSERT_TRUE(error.has_value());
  EXPECT_NEAR(error->to_map.mean(), 0.75 * 0.01, 0.2 * 0.01);
  EXPECT_NEAR(error->to_world.mean(), 3.75 * 0.01, 0.8 * 0.01);
}

TEST(CommonErrors, are_none_if_noise_explains_all) {
  auto frames = frames_with(0.1, 30);
  for (HeldOutFrame& frame : frames) frame.formal.setConstant(0.1);
  EXPECT_EQ(CommonErrors(frames).near({3})->to_map, Vector6d::Zero());
}

TEST(CommonErrors, are_of_the_place) {
  const CommonErrors errors(frames_with(0.1, 60, 5, 150));
  EXPECT_GT(errors.near({280})->to_map.mean(), 1.5 * errors.near({20})->to_map.mean());
}

TEST(CommonErrors, have_what_given_poses_state) {
  auto frames = frames_with(0.01, 20);
  for (HeldOutFrame& frame : frames) frame.stated.setConstant(0.5);
  const auto error = CommonErrors(frames).near({20});
  EXPECT_NEAR((error->to_world - error->to_map).mean(), 0.5, 1e-12);
}

TEST(CommonErrors, count_once_what_the_map_was_moved_by) {
  auto frames = frames_with(0.1, 20);
  const Vector6d unstated = CommonErrors(frames).near({20})->to_world;
  for (HeldOutFrame& frame : frames) frame.stated.setConstant(1e-4);  // less than it was moved by
  EXPECT_LT((CommonErrors(frames).near({20})->to_world - unstated).norm(), 1e-12);
}

TEST(CommonErrors, are_not_known_from_two_frames) {
  EXPECT_FALSE(CommonErrors(frames_with(0.1, 2)).near({2}).has_value());
  EXPECT_FALSE(CommonErrors({}).near({2}).has_value());
  EXPECT_TRUE(CommonErrors(frames_with(0.1, 3)).near({2}).has_value());
}

TEST(Turned, exchanges_the_axes) {
  Vector6d variances;
  variances << 1, 2, 3, 4, 5, 6;
  const Matrix6d covariance = turned(variances, rotation_exp({0, 0, std::acos(0.0)}));  // x becomes y
  Vector6d expected;
  expected << 2, 1, 3, 5, 4, 6;
  EXPECT_LT((covariance - Matrix6d(expected.asDiagonal())).norm(), 1e-12);
}

}  // namespace
}  // namespace cairn
