// SPDX-License-Identifier: Apache-2.0
#include "cairn/simulate/camera_path.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cairn {
namespace {

TEST(camera_path, looking_axes_are_right_down_forward) {
  const Eigen::Matrix3d axes = world_from_looking(0, 0, 0).toRotationMatrix();
  EXPECT_TRUE(axes.col(2).isApprox(Eigen::Vector3d::UnitX()));
  EXPECT_TRUE(axes.col(0).isApprox(-Eigen::Vector3d::UnitY()));
  EXPECT_TRUE(axes.col(1).isApprox(-Eigen::Vector3d::UnitZ()));
  EXPECT_GT(world_from_looking(1, 0.3, 0.2).toRotationMatrix()(2, 2), 0.29);  // looks up
}

TEST(room_path, is_closed) {
  for (const int loops : {1, 2, 5}) {
    RoomPath::Shape shape;
    shape.loops = loops;
    const RoomPath path(shape);
    const Rigid3 motion = path.world_from_camera(0).inverse() * path.world_from_camera(1);
    EXPECT_LT(motion_norm(motion), 1e-9);
  }
}

TEST(room_path, moves_smoothly_at_about_the_speed_asked_for) {
  const RoomPath path(RoomPath::Shape{});  // 4 m in 10 s
  constexpr int kFrames = 300;
  double length = 0;
  Rigid3 before = path.world_from_camera(0);
  Eigen::Vector3d step_before = Eigen::Vector3d::Zero();
  for (int i = 1; i <= kFrames; ++i) {
    const Rigid3 now = path.world_from_camera(static_cast<double>(i) / kFrames);
    const Rigid3 motion = before.inverse() * now;
    const Eigen::Vector3d step = now.translation - before.translation;
    EXPECT_LT(rotation_angle(motion.rotation), 0.05) << i;  // under 3 degrees a frame
    EXPECT_LT(step.norm(), 0.03) << i;
    if (i > 1) {
      EXPECT_LT((step - step_before).norm(), 0.002) << i;
    }
    length += step.norm();
    step_before = step;
    before = now;
  }
  EXPECT_NEAR(length, 4.0, 0.5);
}

TEST(room_path, long_walks_stay_within_the_radius) {
  RoomPath::Shape shape;
  shape.length = 500;
  shape.max_radius = 1.2;
  const RoomPath path(shape);
  for (int i = 0; i < 1000; ++i)
    EXPECT_LT((path.world_from_camera(i * 1e-3).translation - shape.center).head<2>().norm(), 1.6);
}

TEST(street_path, is_closed_and_turns_once) {
  const StreetPath path(StreetPath::Shape{});
  const auto first = path.at(0), last = path.at(1);
  EXPECT_LT((last.position - first.position).norm(), 1e-6);
  EXPECT_NEAR(last.heading - first.heading, 2 * std::numbers::pi, 1e-9);
}

TEST(street_path, drives_where_it_looks_without_jumps) {
  const StreetPath path(StreetPath::Shape{});
  constexpr int kSteps = 2000;
  double length = 0, slowest = 1e9, fastest = 0;
  for (int i = 0; i < kSteps; ++i) {
    const auto a = path.at(static_cast<double>(i) / kSteps), b = path.at((i + 1.0) / kSteps);
    const Eigen::Vector2d step = b.position - a.position;
    const double heading = (a.heading + b.heading) / 2;
    const double sideways = step.x() * -std::sin(heading) + step.y() * std::cos(heading);
    EXPECT_LT(std::abs(sideways), 2e-3 * step.norm()) << i;
    EXPECT_LT(std::abs(b.heading - a.heading), 0.015) << i;
    length += step.norm();
    slowest = std::min(slowest, step.norm());
    fastest = std::max(fastest, step.norm());
  }
  EXPECT_NEAR(length, 160, 0.01);
  EXPECT_NEAR(slowest / fastest, 0.7, 0.02);
}

TEST(street_path, extent_bounds_the_way) {
  const StreetPath path(StreetPath::Shape{});
  Eigen::Vector2d reach(0, 0);
  for (int i = 0; i <= 1000; ++i) reach = reach.cwiseMax(path.at(i * 1e-3).position.cwiseAbs());
  EXPECT_LT((reach - path.half_extent()).norm(), 1e-3);
}

}  // namespace
}  // namespace cairn
