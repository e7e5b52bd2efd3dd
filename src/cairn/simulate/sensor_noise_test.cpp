// SPDX-License-Identifier: Apache-2.0
#include "cairn/simulate/sensor_noise.h"

#include <gtest/gtest.h>

#include <cmath>

namespace cairn {
namespace {

constexpr double kScale = 5000;

Camera test_camera() {
  Camera camera;
  camera.width = 200;
  camera.height = 150;
  camera.fx = camera.fy = 525;
  camera.cx = 99.5;
  camera.cy = 74.5;
  return camera;
}

DepthImage flat(float depth) {
  return {test_camera().width, test_camera().height, depth};
}

struct Moments {
  double mean = 0, deviation = 0, found = 0;
};

template <class Pixel>
Moments moments_of(const Image<Pixel>& image, double unit) {
  double sum = 0, squares = 0, count = 0;
  for (std::size_t i = 0; i < image.size(); ++i) {
    const double value = image.data()[i] / unit;
    if (value == 0) continue;
    sum += value;
    squares += value * value;
    ++count;
  }
  const double mean = sum / count;
  return {mean, std::sqrt(squares / count - mean * mean), count / static_cast<double>(image.size())};
}

TEST(depth_sensor, deviation_follows_the_model) {
  for (const float depth : {0.8F, 1.5F, 2.5F, 3.5F, 4.5F}) {
    double squares = 0;
    constexpr int kDepths = 20;  // spread over more than one step of the disparity
    for (int i = 0; i < kDepths; ++i) {
      DepthSensor sensor;
      sensor.frame = static_cast<std::uint64_t>(i);
      const float here = depth * (1 + 0.002F * static_cast<float>(i));
      const Moments m = moments_of(sense_depth(flat(here), test_camera(), kScale, sensor), kScale);
      EXPECT_EQ(m.found, 1);
      squares += m.deviation * m.deviation + (m.mean - here) * (m.mean - here);
    }
    const double expected = kinect_depth_deviation(depth * 1.019);
    EXPECT_NEAR(std::sqrt(squares / kDepths), expected, 0.05 * expected) << depth;
  }
}

TEST(depth_sensor, noise_is_as_many_times_the_models) {
  DepthSensor sensor;
  sensor.seed = 1;
  sensor.noise_factor = 10;
  const Moments m = moments_of(sense_depth(flat(2.0F), test_camera(), kScale, sensor), kScale);
  EXPECT_NEAR(m.deviation, 10 * kinect_depth_deviation(2), 0.5 * kinect_depth_deviation(2));
}

TEST(depth_sensor, depths_are_whole_steps_of_disparity) {
  const DepthSensor sensor;
  const RawDepthImage raw = sense_depth(flat(4.0F), test_camera(), 1e4, sensor);
  const double focal_baseline = sensor.focal_length * sensor.baseline;
  for (std::size_t i = 0; i < raw.size(); ++i) {
    const double steps = focal_baseline / (raw.data()[i] / 1e4) / sensor.disparity_step;
    ASSERT_NEAR(steps, std::round(steps), 0.002);
  }
}

TEST(depth_sensor, finds_nothing_out_of_range) {
  for (const float depth : {0.0F, 0.3F, 6.0F}) {
    const RawDepthImage raw = sense_depth(flat(depth), test_camera(), kScale, {});
    EXPECT_TRUE(raw == RawDepthImage(raw.width(), raw.height())) << depth;
  }
}

TEST(depth_sensor, near_things_throw_a_shadow_to_their_left) {
  DepthImage depth = flat(3.0F);
  for (int v = 0; v < depth.height(); ++v)
    for (int u = 100; u < 130; ++u) depth(u, v) = 1.0F;
  const RawDepthImage raw = sense_depth(depth, test_camera(), kScale, {});
  const double width = test_camera().fx * 0.075 * (1 / 1.0 - 1 / 3.0);  // 26 pixels
  int left = 0, right = 0;
  for (int u = 50; u < 100; ++u) left += raw(u, 70) == 0 ? 1 : 0;
  for (int u = 130; u < 180; ++u) right += raw(u, 70) == 0 ? 1 : 0;
  EXPECT_NEAR(left, width, 1.5);
  EXPECT_LE(right, 1);  // the edge itself
  EXPECT_NE(raw(115, 70), 0);
}

TEST(depth_sensor, loses_surfaces_at_grazing_sight) {
  const Camera camera = test_camera();
  const auto share_found = [&](double angle_deg) {  // a plane slanted about the vertical axis
    DepthImage depth(camera.width, camera.height);
    const double slope = std::tan(angle_deg * 3.14159265358979 / 180);
    for (int v = 0; v < camera.height; ++v)
      for (int u = 0; u < camera.width; ++u)
        depth(u, v) = static_cast<float>(2.5 / (1 - slope * (u - camera.cx) / camera.fx));
    int found = 0;
    const RawDepthImage raw = sense_depth(depth, camera, kScale, {});
    for (int v = 0; v < raw.height(); ++v) found += raw(100, v) != 0 ? 1 : 0;
    return static_cast<double>(found) / raw.height();
  };
  EXPECT_EQ(share_found(0), 1);
  EXPECT_EQ(share_found(70), 1);
  EXPECT_NEAR(share_found(79.6), 0.5, 0.2);
  EXPECT_EQ(share_found(85), 0);
}

TEST(depth_sensor, rejects_an_impossible_sensor) {
  DepthSensor sensor;
  sensor.max_depth = sensor.min_depth;
  EXPECT_THROW(sensor.validate(), PreconditionError);
}

TEST(stored_depth, is_the_truth_rounded_to_its_unit) {
  const RawDepthImage raw = store_depth(flat(2.34567F), kScale);
  EXPECT_EQ(raw(3, 4), 11728);
  EXPECT_EQ(store_depth(flat(20), kScale)(0, 0), 0);  // too far for 16 bit
}

TEST(image_sensor, noise_has_no_bias_and_the_deviation_asked_for) {
  ImageSensor sensor;
  sensor.deviation = 3;
  sensor.seed = 4;
  const Image<Color> light(300, 200, Color(100, 120, 140));
  const GrayImage gray = expose_gray(light, sensor);
  const double luma = 0.299 * 100 + 0.587 * 120 + 0.114 * 140;
  const Moments m = moments_of(gray, 1);
  EXPECT_NEAR(m.mean, luma, 0.06);
  EXPECT_NEAR(m.deviation, std::sqrt(9 + 1.0 / 12), 0.05);
}

TEST(image_sensor, gain_scales_channels_and_saturates) {
  ImageSensor sensor;
  sensor.gain = Color(1.1F, 1, 3);
  const RgbImage image = expose_rgb(Image<Color>(2, 2, Color(100, 100, 100)), sensor);
  EXPECT_EQ(image(1, 1), (Rgb8{110, 100, 255}));
}

TEST(image_sensor, frames_differ_and_repeat) {
  const Image<Color> light(40, 30, Color(100, 120, 140));
  const auto image_of = [&](std::uint64_t seed, std::uint64_t frame) {
    return expose_rgb(light, {Color::Ones(), 2, seed, frame});
  };
  EXPECT_TRUE(image_of(1, 5) == image_of(1, 5));
  EXPECT_FALSE(image_of(1, 5) == image_of(1, 6));
  EXPECT_FALSE(image_of(1, 5) == image_of(2, 5));
}

}  // namespace
}  // namespace cairn
