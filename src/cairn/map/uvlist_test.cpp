// SPDX-License-Identifier: Apache-2.0
#include "cairn/map/uvlist.h"

#include <gtest/gtest.h>

#include "cairn/map/map.h"

namespace cairn {
namespace {

TEST(Uvlist, tells_how_a_landmark_was_seen) {
  Map map({100, 100, 50, 50, 0.1}, "ORB");
  const Eigen::Vector3d point(3, 0, 4);
  for (int k = 0; k < 2; ++k) {  // the second camera is 3 m further right: straight before the point
    ObservedFrame frame;
    frame.observations.push_back({k == 0 ? 125.0 : 50.0, k == 0 ? 50.0 : 52.0});
    map.add_keyframe(std::move(frame), {Eigen::Quaterniond::Identity(), {3.0 * k, 0, 0}}, {k - 1}, 0);
  }
  const LandmarkId id = map.add_landmark(point, {{0}, 0});
  map.add_sighting(id, {{1}, 0});
  const std::vector<Eigen::Matrix3d> covariances{Eigen::Vector3d(0.01, 0.04, 0.25).asDiagonal()};
  EXPECT_EQ(format_uvlist(map, std::vector{id}, covariances),
            "# id x y z frames std_x std_y std_z rms_px mean_distance min_distance max_distance std_distance "
            "mean_lateral min_lateral max_lateral std_lateral mean_depth min_depth max_depth std_depth "
            "mean_angle_deg min_angle_deg max_angle_deg std_angle_deg\n"
            "0 3 0 4 2 0.1 0.2 0.5 1.41421 4.5 4 5 0.5 1.5 0 3 1.5 4 4 4 0 18.4349 0 36.8699 18.4349\n");
}

}  // namespace
}  // namespace cairn
