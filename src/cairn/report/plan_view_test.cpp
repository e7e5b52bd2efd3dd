// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/plan_view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "cairn/report/plan_legend.h"

namespace cairn {
namespace {

using Eigen::Vector3d;

/// Poses of a camera that looks along `forward` with its picture upright for `up`, and turned a little about
/// that.
std::vector<WorldFromCamera> looking(const Vector3d& forward, const Vector3d& up) {
  std::vector<WorldFromCamera> poses;
  for (const double angle : {-0.3, 0.0, 0.3}) {
    Eigen::Matrix3d rotation;
    rotation.col(2) = Eigen::AngleAxisd(angle, up.normalized()) * forward.normalized();
    rotation.col(0) = rotation.col(2).cross(up).normalized();
    rotation.col(1) = rotation.col(2).cross(rotation.col(0));
    poses.emplace_back(Rigid3{Eigen::Quaterniond(rotation), Vector3d::Zero()});
  }
  return poses;
}

TEST(PlanAxes, the_world_of_a_slam_run_is_seen_along_y_with_z_up) {
  const PlanAxes axes = choose_plan_axes(false, looking(Vector3d::UnitZ(), -Vector3d::UnitY()));
  EXPECT_EQ(axes.right, Vector3d(Vector3d::UnitX()));
  EXPECT_EQ(axes.up, Vector3d(Vector3d::UnitZ()));
  EXPECT_EQ(axes.right_name + axes.up_name, "xz");
}

TEST(PlanAxes, a_world_with_z_up_has_y_up_also_if_the_camera_looks_down_a_little) {
  const PlanAxes axes = choose_plan_axes(false, looking({1, 1, -0.2}, Vector3d(0.2, 0.1, 1)));
  EXPECT_EQ(axes.right, Vector3d(Vector3d::UnitX()));
  EXPECT_EQ(axes.up, Vector3d(Vector3d::UnitY()));
  const PlanAxes hanging = choose_plan_axes(false, looking(Vector3d::UnitX(), -Vector3d::UnitZ()));
  EXPECT_EQ(hanging.right.cross(hanging.up), Vector3d(-Vector3d::UnitZ()));
  EXPECT_EQ(hanging.up_name, "-y");
}

TEST(PlanAxes, a_world_with_x_up_has_y_to_the_right) {
  const PlanAxes axes = choose_plan_axes(false, looking(Vector3d::UnitZ(), Vector3d::UnitX()));
  EXPECT_EQ(axes.right_name + axes.up_name, "yz");
  EXPECT_EQ(axes.right.cross(axes.up), Vector3d(Vector3d::UnitX()));
}

TEST(PlanAxes, a_tilted_world_is_seen_from_where_the_cameras_have_up) {
  const Vector3d up = Vector3d(0, -1, -1).normalized();
  const PlanAxes axes = choose_plan_axes(false, looking({0, -1, 1}, up));
  EXPECT_NEAR(axes.right.cross(axes.up).dot(up), 1, 1e-12);
  EXPECT_NEAR(axes.right.dot(axes.up), 0, 1e-12);
  EXPECT_EQ(axes.right_name + axes.up_name, "");
}

TEST(PlanAxes, a_georeferenced_world_has_north_up_whatever_the_cameras_do) {
  const PlanAxes axes = choose_plan_axes(true, looking(Vector3d::UnitX(), Vector3d::UnitY()));
  EXPECT_EQ(axes.right, Vector3d(Vector3d::UnitX()));
  EXPECT_EQ(axes.up, Vector3d(Vector3d::UnitY()));
  EXPECT_EQ(axes.right_name + axes.up_name, "EN");
}

TEST(PlanView, puts_the_range_into_the_drawing) {
  PlanView view;
  view.origin = {1000, 2000, 30};
  view.corner = {30, 80};
  fit_plan({{-10, 0}, {90, 20}}, {}, view);
  EXPECT_EQ(view.metres({1003, 2004, 7}), Eigen::Vector2d(3, 4));
  const Eigen::Vector2d low = view({990, 2000, 0}), high = view({1090, 2020, 0});
  EXPECT_GE(low.x(), 30);
  EXPECT_LE(low.y(), 80 + view.size.y());
  EXPECT_GE(high.y(), 80);
  EXPECT_LE(high.x(), 30 + view.size.x());
  EXPECT_GT(high.x() - low.x(), 0.9 * view.size.x());
  EXPECT_GT(low.y(), high.y());
  EXPECT_NEAR((high - low).x() / view.pixels_per_metre, 100, 1e-9);
  EXPECT_NEAR((low - high).y() / view.pixels_per_metre, 20, 1e-9);
}

TEST(PlanView, a_range_of_one_point_has_a_view) {
  PlanView view;
  fit_plan({}, {}, view);
  EXPECT_GT(view.pixels_per_metre, 0);
  EXPECT_LE(view.size.x(), 1500);
  EXPECT_LE(view.size.y(), 1100);
}

TEST(FormatLength, has_the_unit_that_reads_best) {
  EXPECT_EQ(format_length(2000), "2 km");
  EXPECT_EQ(format_length(50), "50 m");
  EXPECT_EQ(format_length(0.2), "20 cm");
  EXPECT_EQ(format_length(0.005), "5 mm");
}

TEST(DrawScaleBar, has_its_length_in_pixels) {
  const Rgb8 white{255, 255, 255};
  for (const double pixels_per_metre : {0.01, 3.7, 52.0, 910.0}) {
    RgbImage picture(500, 60, white);
    draw_scale_bar(picture, pixels_per_metre, {480, 50});
    int left = 480;
    while (left > 0 && picture(left - 1, 50) != white) --left;
    const double metres = (480 - left) / pixels_per_metre;
    const double power = std::pow(10, std::floor(std::log10(metres) + 0.02));
    const double leading = metres / power;
    EXPECT_TRUE(std::abs(leading - 1) < 0.05 || std::abs(leading - 2) < 0.1 || std::abs(leading - 5) < 0.2)
        << metres;
    EXPECT_GE(480 - left, 140);
    EXPECT_LE(480 - left, 365);
  }
}

}  // namespace
}  // namespace cairn
