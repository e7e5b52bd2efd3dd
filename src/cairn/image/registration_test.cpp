// SPDX-License-Identifier: Apache-2.0
#include "cairn/image/registration.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace cairn {
namespace {

Camera small_camera(double focal_length) {
  Camera camera;
  camera.width = 64;
  camera.height = 48;
  camera.fx = camera.fy = focal_length;
  camera.cx = 31.5;
  camera.cy = 23.5;
  return camera;
}

/// As tum-fr1, scaled to the small camera.
Camera distorted_camera(double focal_length) {
  Camera camera = small_camera(focal_length);
  camera.model = CameraModel::radtan;
  camera.distortion = {0.2624, -0.9531, -0.0054, 0.0026, 1.1633};
  return camera;
}

/// Pixels without depth within `margin` pixels of the border and more.
int count_holes(const DepthImage& image, int margin) {
  int holes = 0;
  for (int v = margin; v < image.height() - margin; ++v) {
    for (int u = margin; u < image.width() - margin; ++u) holes += image(u, v) == 0.0F ? 1 : 0;
  }
  return holes;
}

TEST(DepthInMetres, scales_and_drops_what_is_invalid) {
  RawDepthImage raw(4, 1);
  raw(0, 0) = 5000;
  raw(1, 0) = 0;
  raw(2, 0) = 65535;
  raw(3, 0) = 1;
  const DepthImage depth = depth_in_metres(raw, 5000.0, {0, 65535});
  EXPECT_EQ(depth(0, 0), 1.0F);
  EXPECT_EQ(depth(1, 0), 0.0F);
  EXPECT_EQ(depth(2, 0), 0.0F);
  EXPECT_NEAR(depth(3, 0), 0.0002F, 1e-9F);
  EXPECT_GT(depth_in_metres(raw, 5000.0, {0})(2, 0), 13.0F);
}

TEST(DepthInMetres, needs_a_scale) {
  EXPECT_THROW((void)depth_in_metres(RawDepthImage(1, 1), 0.0, {0}), PreconditionError);
  EXPECT_THROW((void)depth_in_metres(RawDepthImage(1, 1), std::nan(""), {0}), PreconditionError);
}

TEST(DepthRegistration, of_one_camera_with_itself_changes_nothing) {
  for (const Camera& camera : {small_camera(52.5), distorted_camera(51.7)}) {
    DepthImage depth(64, 48);
    for (std::size_t i = 0; i < depth.size(); ++i)
      depth.data()[i] = i % 7 == 0 ? 0.0F : 0.5F + 0.01F * static_cast<float>(i % 311);
    EXPECT_TRUE(DepthRegistration(camera, camera, {})(depth) == depth) << to_string(camera.model);
  }
}

TEST(DepthRegistration, needs_the_depth_cameras_size) {
  const DepthRegistration registration(small_camera(50), small_camera(50), {});
  EXPECT_THROW((void)registration(DepthImage(63, 48)), PreconditionError);
}

TEST(DepthRegistration, a_sideways_camera_sees_a_plane_shifted_by_its_disparity) {
  const Camera camera = small_camera(50);
  Rigid3 camera_from_depth;
  camera_from_depth.translation = {0.1, -0.04, 0};  // 50 * 0.1 / 1 = 5 columns, 2 rows
  DepthImage depth(64, 48, 1.0F);
  depth(30, 20) = 0.5F;  // shifted by 10 columns and 4 rows
  const DepthImage seen = DepthRegistration(camera, camera, camera_from_depth)(depth);
  EXPECT_EQ(seen(4, 10), 0.0F);
  EXPECT_EQ(seen(5, 10), 1.0F);
  EXPECT_EQ(seen(63, 45), 1.0F);
  EXPECT_EQ(seen(63, 46), 0.0F);
  EXPECT_EQ(seen(40, 16), 0.5F);
  EXPECT_EQ(seen(35, 18), 0.0F);  // where it was cut out of the plane
}

TEST(DepthRegistration, depth_becomes_that_of_the_other_camera) {
  const Camera camera = small_camera(50);
  Rigid3 camera_from_depth;
  camera_from_depth.translation = {0, 0, 0.5};  // the colour camera stands further back
  const DepthImage seen = DepthRegistration(camera, camera, camera_from_depth)(DepthImage(64, 48, 2.0F));
  EXPECT_EQ(seen(32, 24), 2.5F);
  EXPECT_EQ(seen(0, 0), 0.0F);  // outside of what the depth camera sees
}

TEST(DepthRegistration, a_roll_turns_the_image) {
  const Camera camera = small_camera(50);
  Rigid3 camera_from_depth;
  camera_from_depth.rotation = rotation_exp({0, 0, std::acos(-1.0)});
  DepthImage depth(64, 48, 3.0F);
  depth(10, 5) = 2.0F;
  const DepthImage seen = DepthRegistration(camera, camera, camera_from_depth)(depth);
  EXPECT_EQ(seen(53, 42), 2.0F);
  EXPECT_EQ(count_holes(seen, 0), 0);
}

TEST(DepthRegistration, the_nearest_surface_wins_whatever_comes_first) {
  const Camera camera = small_camera(50);
  for (const double sign : {-1.0, 1.0}) {
    Rigid3 camera_from_depth;
    camera_from_depth.translation = {0.2 * sign, 0, 0};
    DepthImage depth(64, 48, 2.0F);  // shifted by 5 columns
    depth(30, 20) = 1.0F;            // shifted by 10, onto what is shifted from column 35 or 25
    const DepthImage seen = DepthRegistration(camera, camera, camera_from_depth)(depth);
    EXPECT_EQ(seen(30 + static_cast<int>(10 * sign), 20), 1.0F);
  }
}

TEST(DepthRegistration, what_lies_behind_the_camera_or_is_no_number_is_left_out) {
  const Camera camera = small_camera(50);
  Rigid3 camera_from_depth;
  camera_from_depth.translation = {0, 0, -1};
  DepthImage depth(64, 48, 0.9F);
  depth(3, 3) = std::numeric_limits<float>::infinity();
  depth(4, 3) = std::numeric_limits<float>::quiet_NaN();
  depth(5, 3) = -1.0F;
  EXPECT_TRUE(DepthRegistration(camera, camera, camera_from_depth)(depth) == DepthImage(64, 48));
}

TEST(DepthRegistration, a_surface_next_to_the_lens_covers_the_image) {
  Camera camera = small_camera(50);
  camera.cx = 31;
  camera.cy = 23;
  Rigid3 camera_from_depth;
  camera_from_depth.translation = {0, 0, -1};
  DepthImage depth(64, 48);
  depth(31, 23) = std::nextafter(1.0F, 2.0F);  // 1.2e-7 m in front of the lens: 4e8 pixels wide
  const DepthImage seen = DepthRegistration(camera, camera, camera_from_depth)(depth);
  EXPECT_EQ(count_holes(seen, 0), 0);
}

TEST(DepthRegistration, a_plane_that_faces_both_cameras_has_no_holes) {
  const Camera depth_camera = small_camera(58.5);
  const DepthImage depth(64, 48, 1.5F);
  Rigid3 camera_from_depth;
  for (const double shift : {0.0, -0.02, 0.0123}) {
    camera_from_depth.translation = {shift, 0, 0};
    for (const double focal_length : {30.0, 52.5, 58.5, 60.0, 70.2, 87.75, 117.0}) {
      const Camera color = small_camera(focal_length);
      const DepthImage seen = DepthRegistration(depth_camera, color, camera_from_depth)(depth);
      const double scale = focal_length / 58.5;
      const int uncovered_u = static_cast<int>(std::ceil(std::max(0.0, 32 * (1 - scale)) + 3));
      const int uncovered_v = static_cast<int>(std::ceil(std::max(0.0, 24 * (1 - scale)) + 3));
      EXPECT_EQ(count_holes(seen, std::max(uncovered_u, uncovered_v)), 0) << focal_length << " " << shift;
    }
  }
}

/// Every span's border falls on a pixel's centre: only rounding decides, and it must not leave gaps.
TEST(DepthRegistration, borders_on_pixel_centres_leave_no_holes) {
  Camera color = small_camera(75);
  Camera depth_camera = small_camera(50);
  for (const double offset : {0.0, 0.25, 0.5, 0.75}) {
    color.cx = color.cy = 20.0 + offset;
    for (const double z : {0.7, 1.0, 1.3}) {
      const DepthImage seen =
          DepthRegistration(depth_camera, color, {})(DepthImage(64, 48, static_cast<float>(z)));
      EXPECT_EQ(count_holes(seen, 0), 0) << offset << " " << z;
    }
  }
}

TEST(DepthRegistration, a_distorted_color_camera_sees_each_point_at_its_distorted_pixel) {
  const Camera depth_camera = small_camera(58.5), color = distorted_camera(51.7);
  DepthImage depth(64, 48);
  const Eigen::Vector2d pixel(6, 40);
  depth(6, 40) = 2.0F;
  const auto expected = color.project(depth_camera.back_project(pixel, 2.0).value());
  const DepthImage seen = DepthRegistration(depth_camera, color, {})(depth);
  EXPECT_EQ(seen(static_cast<int>(std::lround(expected->x())), static_cast<int>(std::lround(expected->y()))),
            2.0F);
}

TEST(DepthRegistration, distortion_that_magnifies_leaves_no_holes) {
  Camera color = small_camera(58.5);
  color.model = CameraModel::radtan;
  color.distortion = {0.5, 0, 0, 0, 0};  // the corners are 1.6 times as large
  const DepthImage seen = DepthRegistration(small_camera(58.5), color, {})(DepthImage(64, 48, 1.0F));
  EXPECT_EQ(count_holes(seen, 0), 0);
}

TEST(DepthRegistration, a_tilted_camera_sees_a_plane_without_holes) {
  Rigid3 camera_from_depth;
  camera_from_depth.rotation = rotation_exp({0.02, -0.03, 0.3});
  const DepthImage seen =
      DepthRegistration(small_camera(40), small_camera(60), camera_from_depth)(DepthImage(64, 48, 1.0F));
  EXPECT_EQ(count_holes(seen, 8), 0);
}

}  // namespace
}  // namespace cairn
