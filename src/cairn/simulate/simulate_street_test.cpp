// SPDX-License-Identifier: Apache-2.0
#include "cairn/simulate/simulate_street.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "cairn/core/error.h"
#include "cairn/testing/core/message_of.h"

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

/// Counts pixels of the left image whose place in the right one is near a pixel's centre, and how many of
/// them look alike there.
struct Likeness {
  int compared = 0, alike = 0;

  void add(double left, double column, const std::uint8_t* row, int width) {
    const int nearest = static_cast<int>(std::lround(column));
    if (nearest < 0 || nearest >= width || std::abs(column - nearest) > 0.05) return;
    ++compared;
    alike += std::abs(left - row[nearest]) <= 8 ? 1 : 0;
  }
};

/// Compares the images of a pair of cameras `baseline` metres apart that are not turned.
Likeness likeness(const SimulatedStereoFrame& pair, double fx, double baseline) {
  Likeness result;
  const int width = pair.left.width();
  for (int v = 0; v < pair.left.height(); ++v) {
    for (int u = 1; u < width - 1; ++u) {
      const double z = pair.depth_true(u, v);
      if (z > 0) result.add(pair.left(u, v), u - fx * baseline / z, pair.right.row(v), width);
    }
  }
  return result;
}

TEST(simulated_street, right_image_is_the_left_one_moved_by_the_disparity) {
  const SimulatedStreet street(small_street(StreetNoise::none));
  for (const int frame : {0, 60, 130}) {
    const Likeness found = likeness(street.render(frame), street.camera().fx, 0.537);
    EXPECT_GT(found.compared, 500);
    EXPECT_GT(found.alike, found.compared * 85 / 100) << frame;  // the rest is hidden in one of them
  }
}

TEST(simulated_street, no_error_is_planted_unless_asked_for) {
  const SimulatedStreet street(small_street(StreetNoise::none));
  const Rigid3 left_from_right = street.left_from_right();
  EXPECT_EQ(left_from_right.rotation.coeffs(), Eigen::Vector4d(0, 0, 0, 1));  // to the last bit
  EXPECT_EQ(left_from_right.translation, Eigen::Vector3d(0.537, 0, 0));
}

TEST(simulated_street, planted_errors_reach_the_right_image_only) {
  SimulateStreetOptions options = small_street(StreetNoise::camera);
  const SimulatedStreet plain(options);
  options.right_rotation_deg = {0.2, -0.1, 0.3};
  options.baseline_error_percent = 3;
  const SimulatedStreet planted(options);
  const SimulatedStereoFrame expected = plain.render(30), frame = planted.render(30);
  EXPECT_TRUE(frame.left == expected.left);
  EXPECT_TRUE(frame.depth_true == expected.depth_true);
  EXPECT_FALSE(frame.right == expected.right);
  EXPECT_EQ(planted.calibration().baseline, plain.calibration().baseline);
  EXPECT_EQ(planted.calibration().camera.fx, plain.calibration().camera.fx);
}

TEST(simulated_street, disparities_are_those_of_the_true_baseline) {
  for (const double percent : {-20.0, 20.0}) {
    SimulateStreetOptions options = small_street(StreetNoise::none);
    options.baseline_error_percent = percent;
    const SimulatedStreet street(options);
    const SimulatedStereoFrame pair = street.render(60);
    const Likeness found = likeness(pair, street.camera().fx, 0.537 * (1 + percent / 100));
    const Likeness stated = likeness(pair, street.camera().fx, *street.calibration().baseline);
    EXPECT_GT(found.alike, found.compared * 85 / 100) << percent;
    EXPECT_LT(stated.alike, stated.compared * 75 / 100) << percent;
  }
}

/// Sums the squared differences of `after`, moved back by whole pixels, and `before` in a window.
double difference(const GrayImage& before, const GrayImage& after, const Eigen::Vector2i& centre,
                  const Eigen::Vector2i& shift) {
  double sum = 0;
  for (int v = centre.y() - 12; v <= centre.y() + 12; ++v)
    for (int u = centre.x() - 20; u <= centre.x() + 20; ++u)
      sum += std::pow(before(u, v) - after(u + shift.x(), v + shift.y()), 2);
  return sum;
}

/// Measures the columns and rows by which the content of a window has moved: searches the whole pixels with
/// the least difference, then the minimum of the parabola through it and its neighbours.
Eigen::Vector2d measure_shift(const GrayImage& before, const GrayImage& after,
                              const Eigen::Vector2i& centre) {
  const auto at = [&](const Eigen::Vector2i& shift) { return difference(before, after, centre, shift); };
  Eigen::Vector2i best(0, 0);
  for (int dv = -5; dv <= 5; ++dv)
    for (int du = -5; du <= 5; ++du)
      if (at({du, dv}) < at(best)) best = {du, dv};
  Eigen::Vector2d shift = best.cast<double>();
  for (int k = 0; k < 2; ++k) {
    const Eigen::Vector2i step = Eigen::Vector2i::Unit(k);
    const double low = at(best - step), high = at(best + step);
    shift[k] += 0.5 * (low - high) / (low - 2 * at(best) + high);
  }
  return shift;
}

constexpr double kFocalLength = 144.3;

/// The angle whose tangent moves a point at the principal point by three pixels.
const double kThreePixels = std::atan(3 / kFocalLength) * 180 / std::numbers::pi;

struct Turn {
  Eigen::Vector3d rotation_deg;
  Eigen::Vector2i centre;  // of the window, in the image of the camera that is not turned
  Eigen::Vector2d shift;   // columns, rows
};

TEST(simulated_street, a_turned_right_camera_moves_the_image) {
  const Eigen::Vector2i middle(121, 34), right(201, 34), left(41, 34);
  const double roll = std::asin(3.0 / 80) * 180 / std::numbers::pi;  // three rows at 80 columns
  const Turn turns[] = {{{kThreePixels, 0, 0}, middle, {0, 3}},  {{-kThreePixels, 0, 0}, middle, {0, -3}},
                        {{0, kThreePixels, 0}, middle, {-3, 0}}, {{0, -kThreePixels, 0}, middle, {3, 0}},
                        {{0, 0, roll}, right, {0, -3}},          {{0, 0, roll}, left, {0, 3}}};
  SimulateStreetOptions options = small_street(StreetNoise::none);
  const GrayImage straight = SimulatedStreet(options).render(60).right;
  for (const Turn& turn : turns) {
    options.right_rotation_deg = turn.rotation_deg;
    const GrayImage turned = SimulatedStreet(options).render(60).right;
    const Eigen::Vector2d shift = measure_shift(straight, turned, turn.centre);
    EXPECT_LT((shift - turn.shift).norm(), 0.15)
        << turn.rotation_deg.transpose() << ": " << shift.transpose();
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

/// Expects that the options are refused with this message.
void expect_refused(const SimulateStreetOptions& options, const char* message) {
  EXPECT_EQ(testkit::message_of([&] { return options.validate(); }), message);
}

TEST(simulated_street, wrong_options_are_named) {
  SimulateStreetOptions options;
  options.baseline = 0;
  expect_refused(options, "--baseline: expected a baseline above 0 m, found 0.\n  Choose another value.");
}

TEST(simulated_street, errors_out_of_range_are_named) {
  SimulateStreetOptions turned, longer, undefined;
  turned.right_rotation_deg = {0, 0, -5.5};
  longer.baseline_error_percent = 21;
  undefined.right_rotation_deg.x() = std::numeric_limits<double>::quiet_NaN();
  expect_refused(
      turned, "--right-rotation: expected angles from -5 to 5 degrees, found -5.5.\n  Choose another value.");
  expect_refused(
      undefined,
      "--right-rotation: expected angles from -5 to 5 degrees, found nan.\n  Choose another value.");
  expect_refused(longer,
                 "--baseline-error: expected an error from -20 to 20 %, found 21.\n  Choose another value.");
}

TEST(simulated_street, a_straight_one_is_driven_straight_at_constant_speed) {
  SimulateStreetOptions options = small_street(StreetNoise::none);
  options.frames_count = 40;
  options.route = StreetRoute::straight;
  const Trajectory truth = SimulatedStreet(options).truth();
  const double first =
      (truth[1].world_from_camera.translation - truth[0].world_from_camera.translation).norm();
  for (std::size_t i = 1; i < truth.size(); ++i) {
    const Rigid3 step = truth[i - 1].world_from_camera.inverse() * truth[i].world_from_camera;
    EXPECT_NEAR(step.translation.norm(), first, 0.003) << i;  // the springs
    EXPECT_LT(rotation_angle(truth[i].world_from_camera.rotation), 0.025) << i;
  }
  EXPECT_GT(first, 0.7);
}

/// Returns the poses of a body whose camera was planted with errors.
std::vector<std::pair<std::int64_t, Rigid3>> poses_with(const SimulatedBodyPoses& errors) {
  SimulateStreetOptions options = small_street(StreetNoise::none);
  options.frames_count = 20;
  options.body_poses = errors;
  return SimulatedStreet(options).body_poses();
}

TEST(simulated_street, poses_of_the_body_carry_the_camera_with_its_planted_errors) {
  SimulateStreetOptions options = small_street(StreetNoise::none);
  options.frames_count = 20;
  SimulatedBodyPoses errors;
  errors.time_offset_s = 0.2;
  errors.lever_arm_error = {0.1, 0, -0.3};
  errors.boresight_error_deg = {0, 0, 9};
  const SimulatedStreet street(options);
  const auto poses = poses_with(errors);
  ASSERT_EQ(poses.size(), 191U);  // 100 a second for 1.9 s
  const Rigid3 stated = SimulatedStreet::stated_body_from_camera();
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(std::numbers::pi / 20, Eigen::Vector3d::UnitZ()));
  const Rigid3 body_from_camera{turn * stated.rotation, stated.translation + errors.lever_arm_error};
  EXPECT_EQ(poses[30].first, 300'000'000);
  const Rigid3 camera = poses[30].second * body_from_camera;  // 0.2 s later than its stamp says: frame 5
  EXPECT_LT(motion_norm(camera.inverse() * street.world_from_camera(5)), 1e-9);
}

TEST(simulated_street, without_poses_of_the_body_nothing_is_stated_of_it) {
  const SimulatedStreet street(small_street(StreetNoise::none));
  EXPECT_TRUE(street.body_poses().empty());
  EXPECT_FALSE(street.calibration().body_from_camera);
}

TEST(simulated_street, poses_of_the_body_out_of_range_are_refused) {
  SimulatedBodyPoses far, turned, late;
  far.lever_arm_error.y() = 10.5;
  turned.boresight_error_deg.z() = std::numeric_limits<double>::quiet_NaN();
  late.time_offset_s = -11;
  for (const SimulatedBodyPoses& errors : {far, turned, late})
    EXPECT_THROW((void)poses_with(errors), InputError);
}

}  // namespace
}  // namespace cairn
