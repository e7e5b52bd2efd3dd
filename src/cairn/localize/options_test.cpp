// SPDX-License-Identifier: Apache-2.0
#include "cairn/localize/options.h"

#include <gtest/gtest.h>

#include "cairn/testing/core/nan_parameters.h"

namespace cairn {
namespace {

TEST(LocalizeOptions, that_are_not_numbers_are_refused_by_name) {
  EXPECT_GT(testkit::expect_nan_is_refused<LocalizeOptions>(), 5U);
}

MapInfo map_of(double fx, double fy) {
  MapInfo map;
  map.rig = {fx, fy, 319.5, 239.5, 0.1};
  map.width = 640;
  map.height = 480;
  return map;
}

Camera camera_of(int width, int height, double focal) {
  return {CameraModel::radtan, width,      height, focal, focal, 0.5 * (width - 1),
          0.5 * (height - 1),  {-0.2, 0.1}};
}

TEST(CameraForQueries, has_the_pixels_per_radian_of_the_map) {
  const Camera photo = camera_of(1600, 1200, 1250);
  const Camera resized = camera_for_queries(map_of(500, 500), photo);
  EXPECT_EQ(resized.width, 640);
  EXPECT_EQ(resized.height, 480);
  EXPECT_NEAR(resized.fx, 500, 1e-9);
  EXPECT_NEAR(resized.cx, 319.5, 1e-9);
  EXPECT_EQ(resized.model, CameraModel::radtan);
  EXPECT_EQ(resized.distortion, photo.distortion);
  const Camera wide = camera_for_queries(map_of(500, 500), camera_of(4000, 3000, 1000));  // of twice the view
  EXPECT_EQ(wide.width, 2000);
  EXPECT_NEAR(wide.fx, 500, 1e-9);
}

TEST(CameraForQueries, sides_are_whole_and_the_focal_lengths_are_theirs) {
  const Camera photo = camera_of(1601, 1201, 1250);
  const Camera resized = camera_for_queries(map_of(500, 500), photo);
  EXPECT_EQ(resized.width, 640);
  EXPECT_DOUBLE_EQ(resized.fx, photo.fx * 640 / 1601);
  EXPECT_DOUBLE_EQ(resized.fy, photo.fy * 480 / 1201);
  EXPECT_DOUBLE_EQ(resized.cy, (photo.cy + 0.5) * 480 / 1201 - 0.5);
}

TEST(CameraForQueries, like_resolution_stays) {
  for (const double focal : {460.0, 500.0, 540.0}) {
    const Camera photo = camera_of(700, 500, focal);
    const Camera same = camera_for_queries(map_of(500, 500), photo);
    EXPECT_EQ(same.width, 700);
    EXPECT_EQ(same.fx, focal);
    EXPECT_EQ(same.cx, photo.cx);
  }
}

TEST(CameraForQueries, enlarges_at_most_twice) {
  EXPECT_EQ(camera_for_queries(map_of(500, 500), camera_of(400, 300, 312.5)).width, 640);
  EXPECT_EQ(camera_for_queries(map_of(500, 500), camera_of(160, 120, 125)).width, 320);
}

TEST(ObserverOptionsFor, takes_the_noise_that_the_map_states) {
  MapInfo map;
  map.depth_noise = DisparityNoise{0.3, 0.002};
  EXPECT_EQ(observer_options_for(map, 100, 0.02).depth_noise.stated.sigma_px, 0.3);
  EXPECT_EQ(observer_options_for(map, 100, 0.02).depth_noise.stated.sigma_m, 0.002);
  map.depth_noise = DisparityNoise{0.03, 0.002};  // smaller than is believed
  EXPECT_EQ(observer_options_for(map, 100, 0.02).depth_noise.stated.sigma_px, kKinectNoise.sigma_px);
  map.depth_noise.reset();
  EXPECT_EQ(observer_options_for(map, 100, 0.02).depth_noise.stated.sigma_px, kKinectNoise.sigma_px);
}

}  // namespace
}  // namespace cairn
