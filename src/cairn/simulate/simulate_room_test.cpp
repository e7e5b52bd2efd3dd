// SPDX-License-Identifier: Apache-2.0
#include "cairn/simulate/simulate_room.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

namespace cairn {
namespace {

SimulateRoomOptions small_room(RgbdNoise noise) {
  SimulateRoomOptions options;
  options.camera = resized(options.camera, 0.25);
  options.noise = noise;
  options.seed = 5;
  return options;
}

TEST(simulated_room, is_the_same_at_any_number_of_threads) {
  std::vector<SimulatedRgbdFrame> reference;
  for (const int threads : {1, 2, 4}) {
    const Executor executor(threads);
    const SimulatedRoom room(small_room(RgbdNoise::kinect), executor);
    const auto frames = executor.map<SimulatedRgbdFrame>(
        3, [&](std::size_t i) { return room.render(static_cast<int>(i) * 50); });
    if (threads == 1) reference = frames;
    for (std::size_t i = 0; i < frames.size(); ++i) {
      EXPECT_TRUE(frames[i].color == reference[i].color);
      EXPECT_TRUE(frames[i].depth == reference[i].depth);
      EXPECT_TRUE(frames[i].depth_true == reference[i].depth_true);
    }
  }
}

TEST(simulated_room, another_seed_makes_another_room) {
  SimulateRoomOptions options = small_room(RgbdNoise::none);
  const RgbImage first = SimulatedRoom(options).render(0).color;
  options.seed = 6;
  EXPECT_FALSE(first == SimulatedRoom(options).render(0).color);
}

TEST(simulated_room, ends_where_it_began) {
  const SimulatedRoom room(small_room(RgbdNoise::none));
  const Trajectory truth = room.truth();
  ASSERT_EQ(truth.size(), 300U);
  EXPECT_EQ(truth[30].stamp_ns, 1'000'000'000);
  const Rigid3 closing = truth.back().world_from_camera.inverse() * truth.front().world_from_camera;
  const Rigid3 step = truth[0].world_from_camera.inverse() * truth[1].world_from_camera;
  EXPECT_NEAR(motion_norm(closing), motion_norm(step), 0.2 * motion_norm(step));
}

TEST(simulated_room, few_frames_make_a_part_of_a_walk_unless_loops_are_given) {
  const auto turn_per_frame = [](int loops) {
    SimulateRoomOptions options = small_room(RgbdNoise::none);
    options.frames_count = 24;
    options.loops = loops;
    const Trajectory truth = SimulatedRoom(options).truth();
    const Rigid3 step = truth[0].world_from_camera.inverse() * truth[1].world_from_camera;
    return rotation_angle(step.rotation);
  };
  EXPECT_LT(turn_per_frame(0), 0.05);
  EXPECT_GT(turn_per_frame(1), 0.15);
}

/// How well frame `to` sees the points of frame `from` where the truth predicts them, among those that fall
/// into its image and are not hidden there.
struct Agreement {
  double worst_depth_error = 0;  ///< metres
  double color_error = 0;        ///< mean, grey levels of the green channel
  int compared = 0;
};

Agreement compare_views(const SimulatedRoom& room, int from, int to) {
  const SimulatedRgbdFrame a = room.render(from), b = room.render(to);
  const Rigid3 to_from_from = room.world_from_camera(to).inverse() * room.world_from_camera(from);
  const Camera& camera = room.camera();
  Agreement agreement;
  for (int v = 1; v < camera.height - 1; v += 2) {
    for (int u = 1; u < camera.width - 1; u += 2) {
      const auto point = camera.back_project(Eigen::Vector2d(u, v), a.depth_true(u, v));
      const Eigen::Vector3d point_in_to = to_from_from * *point;
      const auto pixel = camera.project(point_in_to);
      if (!pixel || !camera.contains(*pixel)) continue;
      const int x = static_cast<int>(std::lround(pixel->x())), y = static_cast<int>(std::lround(pixel->y()));
      if ((*pixel - Eigen::Vector2d(x, y)).norm() > 0.05) continue;  // nearly a pixel's centre
      const double error = std::abs(b.depth_true(x, y) - point_in_to.z());
      if (error > 0.05) continue;  // hidden there
      agreement.worst_depth_error = std::max(agreement.worst_depth_error, error);
      agreement.color_error += std::abs(a.color(u, v).g - b.color(x, y).g);
      ++agreement.compared;
    }
  }
  agreement.color_error /= agreement.compared;
  return agreement;
}

TEST(simulated_room, views_agree_through_the_true_poses) {
  const SimulatedRoom room(small_room(RgbdNoise::none));
  for (const auto& [from, to] : {std::pair{0, 8}, std::pair{100, 93}, std::pair{295, 3}}) {
    const Agreement agreement = compare_views(room, from, to);
    EXPECT_GT(agreement.compared, 15) << from;
    EXPECT_LT(agreement.worst_depth_error, 0.01) << from;  // 0.05 pixels on slanted surfaces
    EXPECT_LT(agreement.color_error, 3) << from;
  }
}

TEST(simulated_room, sees_walls_all_around) {
  const SimulatedRoom room(small_room(RgbdNoise::none));
  for (int i = 0; i < room.size(); i += 37) {
    const DepthImage depth = room.render(i).depth_true;
    for (std::size_t k = 0; k < depth.size(); ++k) {
      ASSERT_GT(depth.data()[k], 0.5F);
      ASSERT_LT(depth.data()[k], 7.0F);
    }
  }
}

TEST(simulated_room, without_noise_depth_is_stored_true) {
  const SimulatedRgbdFrame frame = SimulatedRoom(small_room(RgbdNoise::none)).render(10);
  for (std::size_t i = 0; i < frame.depth.size(); ++i)
    ASSERT_NEAR(frame.depth.data()[i] / 5000.0, frame.depth_true.data()[i], 0.5001 / 5000);
}

TEST(simulated_room, kinect_depth_is_near_the_truth_where_it_is_found) {
  const SimulatedRgbdFrame frame = SimulatedRoom(small_room(RgbdNoise::kinect)).render(10);
  std::size_t found = 0;
  for (std::size_t i = 0; i < frame.depth.size(); ++i) {
    if (frame.depth.data()[i] == 0) continue;
    ++found;
    const double z = frame.depth_true.data()[i];
    ASSERT_NEAR(frame.depth.data()[i] / 5000.0, z, 5 * kinect_depth_deviation(z));
  }
  EXPECT_GT(found, frame.depth.size() * 8 / 10);
  EXPECT_LT(found, frame.depth.size());
}

TEST(simulated_room, calibration_is_complete) {
  const Calibration calibration = SimulatedRoom(small_room(RgbdNoise::none)).calibration();
  EXPECT_EQ(calibration.camera.width, 160);
  EXPECT_DOUBLE_EQ(calibration.camera.cx, 79.5);
  ASSERT_TRUE(calibration.depth);
  EXPECT_EQ(calibration.depth->scale, 5000);
}

TEST(simulated_room, wrong_options_are_named) {
  struct Case {
    const char* option;
    std::function<void(SimulateRoomOptions&)> spoil;
  };
  const Case cases[] = {
      {"--frames-count", [](auto& o) { o.frames_count = 0; }},
      {"--speed", [](auto& o) { o.speed = -1; }},
      {"--loops", [](auto& o) { o.loops = -1; }},
      {"rate_hz", [](auto& o) { o.rate_hz = 0; }},
      {"camera", [](auto& o) { o.camera.fx = 0; }},
      {"camera", [](auto& o) { o.camera.model = CameraModel::kb4; }},
      {"depth_scale", [](auto& o) { o.depth_scale = 0; }},
      {"image_deviation", [](auto& o) { o.image_deviation = -1; }},
  };
  for (const Case& c : cases) {
    SimulateRoomOptions options;
    c.spoil(options);
    try {
      options.validate();
      ADD_FAILURE() << c.option;
    } catch (const InputError& error) {
      EXPECT_EQ(error.details().file, c.option);
    }
  }
}

}  // namespace
}  // namespace cairn
