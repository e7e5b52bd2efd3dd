// SPDX-License-Identifier: Apache-2.0
#include "cairn/geometry/stereo_correction.h"

#include <gtest/gtest.h>

namespace cairn {
namespace {

const Rig kRig{500, 400, 320, 240, 0.2};

StereoCorrection some_correction() {
  StereoCorrection correction;
  correction.rows << 0.5, 0, 0, -2, 0, 1;
  correction.disparity = {-0.3, 0.1, -1};
  return correction;
}

TEST(StereoCorrection, takes_the_field_at_the_left_column_off) {
  const StereoCorrection correction = some_correction();
  EXPECT_DOUBLE_EQ(correction.corrected(kRig, 320, 10), 10.3);
  EXPECT_DOUBLE_EQ(correction.corrected(kRig, 570, 10), 10.3 - 0.05 + 0.25);  // x = 0.5
}

TEST(StereoCorrection, rows_follow_the_right_column_and_the_left_row) {
  const StereoCorrection correction = some_correction();
  EXPECT_DOUBLE_EQ(correction.right_row(kRig, 320, 240), 239.5);
  EXPECT_DOUBLE_EQ(correction.right_row(kRig, 570, 440), 440 - (0.5 - 2 * 0.25 + 0.25));  // x = y = 0.5
}

TEST(StereoCorrection, the_right_pixel_is_where_the_point_was_seen) {
  const StereoCorrection correction = some_correction();
  const double measured = 12.5, u = 400, v = 300;
  const Eigen::Vector2d pixel = correction.right_pixel(kRig, u, v, correction.corrected(kRig, u, measured));
  EXPECT_NEAR(pixel.x(), u - measured, 1e-12);
  EXPECT_NEAR(pixel.y(), correction.right_row(kRig, u - measured, v), 1e-12);
}

TEST(StereoCorrection, none_changes_nothing) {
  const StereoCorrection none;
  EXPECT_EQ(none.right_pixel(kRig, 400, 300, 10), Eigen::Vector2d(390, 300));
  EXPECT_EQ(none.corrected(kRig, 400, 10), 10);
}

}  // namespace
}  // namespace cairn
