// SPDX-License-Identifier: Apache-2.0
#include "cairn/map/uvlist.h"

#include <gtest/gtest.h>

#include <cmath>

namespace cairn {
namespace {

TEST(Uvlist, tells_how_a_landmark_was_seen) {
  const Eigen::Matrix3d covariance = Eigen::Vector3d(0.01, 0.04, 0.25).asDiagonal();
  LandmarkIndicators indicators;
  indicators.frames = 2;
  indicators.rms_px = std::sqrt(2.0);
  indicators.distance = {4.5, 4, 5, 0.5};
  indicators.lateral = {1.5, 0, 3, 1.5};
  indicators.depth = {4, 4, 4, 0};
  indicators.angle_deg = {18.4349488, 0, 36.8698976, 18.4349488};
  EXPECT_EQ(format_uvlist_row(7, {3, 0, 4}, covariance, indicators),
            "7 3 0 4 2 0.1 0.2 0.5 1.41421 4.5 4 5 0.5 1.5 0 3 1.5 4 4 4 0 18.4349 0 36.8699 18.4349\n");
}

TEST(Uvlist, names_its_columns) {
  EXPECT_EQ(uvlist_header(),
            "# id x y z frames std_x std_y std_z rms_px mean_distance min_distance max_distance std_distance "
            "mean_lateral min_lateral max_lateral std_lateral mean_depth min_depth max_depth std_depth "
            "mean_angle_deg min_angle_deg max_angle_deg std_angle_deg\n");
}

}  // namespace
}  // namespace cairn
