// SPDX-License-Identifier: Apache-2.0
#include "cairn/simulate/simulate_street.h"

#include <gtest/gtest.h>

#include <cmath>

namespace cairn {
namespace {

SimulateStreetOptions small_street(StreetNoise noise) {
  SimulateStreetOptions options;
  options.camera.width = 248;
  options.camera.height = 75;
  options.camera.fx = options.camera.fy = 144.3;
  options.camera.cx = 121.5;
  options.camera.cy = 34.1;
  options.noise = noise;
  options.seed = 3;
  return options;
}

TEST(simulated_street, is_the_same_at_any_number_of_threads) {
  std::vector<SimulatedStereoFrame> reference;
  for (const int threads : {1, 2, 4}) {
    const Executor executor(threads);
    const SimulatedStreet street(small_street(StreetNoise::camera), executor);
    const auto frames = executor.map<SimulatedStereoFrame>(
        3, [&](std::size_t i) { return street.render(static_cast<int>(i) * 40); });
    if (threads == 1) reference = frames;
    for (std::size_t i = 0; i < frames.size(); ++i) {
      EXPECT_TRUE(frames[i].left == reference[i].left);
      EXPECT_TRUE(frames[i].right == reference[i].right);
    }
  }
}

TEST(simulated_street, begins_at_the_origin_and_ends_there) {
  const SimulatedStreet street(small_street(StreetNoise::none));
  const Trajectory truth = street.truth();
  EXPECT_LT(motion_norm(truth.front().world_from_camera), 1e-12);
  EXPECT_LT(truth.back().world_from_camera.translation.norm(), 1.5);  // a frame's way
  double length = 0;
  for (std::size_t i = 1; i < truth.size(); ++i) {
    const Rigid3 step = truth[i - 1].world_from_camera.inverse() * truth[i].world_from_camera;
    EXPECT_LT(rotation_angle(step.rotation), 0.12) << i;
    EXPECT_GT(step.translation.z(), 0.4) << i;  // forwards
    EXPECT_LT(step.translation.norm(), 1.2) << i;
    length += step.translation.norm();
  }
  EXPECT_NEAR(length, 160, 2);
}

TEST(simulated_street, right_image_is_the_left_one_moved_by_the_disparity) {
  const SimulatedStreet street(small_street(StreetNoise::none));
  for (const int frame : {0, 60, 130}) {
    const SimulatedStereoFrame pair = street.render(frame);
    int compared = 0, alike = 0;
    for (int v = 0; v < pair.left.height(); ++v) {
      for (int u = 1; u < pair.left.width() - 1; ++u) {
        const double z = pair.depth_true(u, v);
        if (z == 0) continue;
        const double x = u - street.camera().fx * 0.537 / z;
        const int nearest = static_cast<int>(std::lround(x));
        if (nearest < 0 || std::abs(x - nearest) > 0.05) continue;
        ++compared;
        alike += std::abs(pair.left(u, v) - pair.right(nearest, v)) <= 8 ? 1 : 0;
      }
    }
    EXPECT_GT(compared, 500);
    EXPECT_GT(alike, compared * 85 / 100) << frame;  // the rest is hidden in one of them
  }
}

TEST(simulated_street, leaves_the_road_free) {
  const SimulatedStreet street(small_street(StreetNoise::none));
  for (int i = 0; i < street.size(); i += 11) {
    const DepthImage depth = street.render(i).depth_true;
    for (std::size_t k = 0; k < depth.size(); ++k)
      ASSERT_TRUE(depth.data()[k] == 0 || depth.data()[k] > 1.5F) << i;
    EXPECT_GT(depth(120, 40), 5.0F) << i;
  }
}

TEST(simulated_street, few_frames_make_a_part_of_a_round) {
  SimulateStreetOptions options = small_street(StreetNoise::none);
  options.frames_count = 10;
  const Trajectory truth = SimulatedStreet(options).truth();
  const double step = truth[1].world_from_camera.translation.norm();
  EXPECT_GT(step, 0.5);
  EXPECT_LT(step, 1.2);
}

TEST(simulated_street, wrong_options_are_named) {
  SimulateStreetOptions options;
  options.baseline = 0;
  try {
    options.validate();
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "--baseline: expected a baseline above 0 m, found 0.\n  Choose another value.");
  }
}

}  // namespace
}  // namespace cairn
