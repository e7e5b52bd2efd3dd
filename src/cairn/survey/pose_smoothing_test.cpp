// SPDX-License-Identifier: Apache-2.0
#include "cairn/survey/pose_smoothing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "cairn/core/random.h"
#include "cairn/testing/geometry/camera_paths.h"
#include "cairn/testing/survey/point_drive.h"

namespace cairn {
namespace {

using testkit::kDriveRig;

constexpr int kFrames = 61, kReach = 10;

struct DriveNoise {
  double given_m = 0, given_rad = 0;    ///< white, of each given pose, per axis
  double motion_m = 0, motion_rad = 0;  ///< of each motion, per axis, as it is stated
};

/// A perturbation of that size per axis.
Rigid3 perturbed(const Rigid3& pose, double radians, double metres, Random& random) {
  Vector6d xi;
  for (Eigen::Index i = 0; i < 6; ++i) xi[i] = (i < 3 ? radians : metres) * random.normal();
  const Rigid3 moved = perturb_left(xi, Rigid3{pose.rotation, Eigen::Vector3d::Zero()});
  return {moved.rotation, pose.translation + moved.translation};
}

/// A drive whose given poses and motions are noisy, without images; drive_pose is the truth.
FrameBuffer noisy_drive(const DriveNoise& noise, std::uint64_t seed = 3) {
  Random random(seed);
  FrameBuffer frames;
  for (int i = 0; i < kFrames; ++i) {
    const WorldFromCamera given(perturbed(testkit::on_bend(i), noise.given_rad, noise.given_m, random));
    frames.push_back(testkit::see({}, i, given));
    if (i == 0) continue;
    const Rigid3 step = testkit::on_bend(i - 1).inverse() * Rigid3(testkit::on_bend(i));
    frames[KeyframeId{i}].motion =
        VisualMotion{perturbed(step, noise.motion_rad, noise.motion_m, random),
                     noise.motion_rad * noise.motion_rad, noise.motion_m * noise.motion_m};
  }
  return frames;
}

double distance(const Rigid3& a, const Rigid3& b) {
  return (a.translation - b.translation).norm();
}

double angle_between(const Rigid3& a, const Rigid3& b) {
  return rotation_angle(a.rotation.conjugate() * b.rotation);
}

const Rigid3& given_pose(const FrameBuffer& frames, int frame) {
  return frames[KeyframeId{frame}].given.world_from_camera;
}

/// Root mean squares over the frames that have neighbours on both sides, of given and of smoothed poses.
struct Errors {
  double given_m = 0, given_rad = 0, smoothed_m = 0, smoothed_rad = 0;
};

Errors errors_of(const FrameBuffer& frames) {
  Errors sums;
  int count = 0;
  for (int i = kReach; i < kFrames - kReach; ++i, ++count) {
    const WorldFromCamera truth = testkit::on_bend(i), smoothed = smoothed_pose(frames, {i}, kReach);
    sums.given_m += std::pow(distance(given_pose(frames, i), truth), 2);
    sums.given_rad += std::pow(angle_between(given_pose(frames, i), truth), 2);
    sums.smoothed_m += std::pow(distance(smoothed, truth), 2);
    sums.smoothed_rad += std::pow(angle_between(smoothed, truth), 2);
  }
  return {std::sqrt(sums.given_m / count), std::sqrt(sums.given_rad / count),
          std::sqrt(sums.smoothed_m / count), std::sqrt(sums.smoothed_rad / count)};
}

TEST(SmoothedPose, exact_poses_stay) {
  const Errors errors = errors_of(noisy_drive({}));
  EXPECT_LT(errors.smoothed_m, 1e-9);
  EXPECT_LT(errors.smoothed_rad, 1e-9);
}

TEST(SmoothedPose, noisy_motions_hardly_move_exact_poses) {
  // That there is no jitter is not known exactly, from twenty motions.
  const Errors errors = errors_of(noisy_drive({.motion_m = 0.02, .motion_rad = 2e-4}));
  EXPECT_LT(errors.smoothed_m, 0.3 * 0.02 * std::sqrt(3.0));
  EXPECT_LT(errors.smoothed_rad, 0.3 * 2e-4 * std::sqrt(3.0));
}

TEST(SmoothedPose, jitter_is_averaged_out) {
  const FrameBuffer frames =
      noisy_drive({.given_m = 0.04, .given_rad = 5e-4, .motion_m = 0.002, .motion_rad = 2e-5});
  const Errors errors = errors_of(frames);
  EXPECT_NEAR(errors.given_m, 0.04 * std::sqrt(3.0), 0.015);
  EXPECT_LT(errors.smoothed_m, errors.given_m / 3);
  EXPECT_LT(errors.smoothed_rad, errors.given_rad / 3);
}

TEST(SmoothedPose, poor_motions_are_not_followed_far) {
  const FrameBuffer frames = noisy_drive({.given_m = 0.01, .motion_m = 0.05, .motion_rad = 1e-6});
  const Errors errors = errors_of(frames);
  EXPECT_LT(errors.smoothed_m, 1.1 * errors.given_m);
}

TEST(SmoothedPose, keeps_the_place_that_is_given) {
  const Rigid3 offset{rotation_exp({0.02, -0.5, 0.01}), {10, -2, 300}};
  FrameBuffer frames = noisy_drive({});
  for (int i = 0; i < kFrames; ++i) {
    auto& given = frames[KeyframeId{i}].given.world_from_camera;
    given = WorldFromCamera(offset * given);
  }
  for (const int i : {kReach, 30, kFrames - 1}) {
    const WorldFromCamera smoothed = smoothed_pose(frames, {i}, kReach);
    EXPECT_LT(distance(smoothed, given_pose(frames, i)), 1e-9);
    EXPECT_LT(angle_between(smoothed, given_pose(frames, i)), 1e-9);
  }
}

TEST(SmoothedPose, keeps_a_steady_drift) {
  FrameBuffer frames = noisy_drive({});
  for (int i = 0; i < kFrames; ++i)
    frames[KeyframeId{i}].given.world_from_camera.translation += i * Eigen::Vector3d(0.01, 0, -0.02);
  for (int i = kReach; i < kFrames - kReach; ++i)
    EXPECT_LT(distance(smoothed_pose(frames, {i}, kReach), given_pose(frames, i)), 1e-6);
}

TEST(SmoothedPose, motions_that_are_all_too_short_do_not_move_exact_poses) {
  FrameBuffer frames = noisy_drive({.motion_m = 0.002});
  for (int i = 1; i < kFrames; ++i) frames[KeyframeId{i}].motion->previous_from_this.translation *= 0.9;
  for (int i = 0; i < kFrames; ++i)  // also the first and the last, which have neighbours on one side only
    EXPECT_LT(distance(smoothed_pose(frames, {i}, kReach), given_pose(frames, i)), 0.02) << i;
}

TEST(SmoothedPose, goes_no_further_than_motions_lead) {
  FrameBuffer frames = noisy_drive({.given_m = 0.04, .motion_m = 0.002});
  const auto move_from = [](int first, FrameBuffer moved) {
    for (int i = first; i < kFrames; ++i) moved[KeyframeId{i}].given.world_from_camera.translation.x() += 1;
    return moved;
  };
  EXPECT_GT(distance(smoothed_pose(frames, {30}, kReach), smoothed_pose(move_from(33, frames), {30}, kReach)),
            0.1);
  frames[KeyframeId{33}].motion.reset();
  EXPECT_LT(distance(smoothed_pose(frames, {30}, kReach), smoothed_pose(move_from(33, frames), {30}, kReach)),
            1e-12);
  EXPECT_GT(distance(smoothed_pose(frames, {30}, kReach), given_pose(frames, 30)), 1e-3);
}

TEST(SmoothedPose, reaches_so_many_frames) {
  const FrameBuffer frames = noisy_drive({.given_m = 0.04, .motion_m = 0.002});
  FrameBuffer other = frames;
  other[KeyframeId{30 + kReach + 1}].given.world_from_camera.translation.x() += 1;
  EXPECT_EQ(distance(smoothed_pose(frames, {30}, kReach), smoothed_pose(other, {30}, kReach)), 0);
  EXPECT_EQ(distance(smoothed_pose(frames, {30}, 0), given_pose(frames, 30)), 0);
}

/// How far the cameras around frame 30 are, relative to it, from where they truly were, RMS.
double relative_error_m(const std::vector<Rigid3>& world_from_camera) {
  double sum = 0;
  for (int i = 20; i <= 40; ++i) {
    const Rigid3 found = world_from_camera[30].inverse() * world_from_camera[static_cast<std::size_t>(i)];
    const Rigid3 truth = testkit::on_bend(30).inverse() * Rigid3(testkit::on_bend(i));
    sum += std::pow(distance(found, truth), 2);
  }
  return std::sqrt(sum / 20);
}

std::vector<Rigid3> around_frame_30(const FrameBuffer& frames) {
  std::vector<Rigid3> poses;
  for (const CameraFromWorld& camera : cameras_around(frames, {30}, kReach))
    poses.push_back(camera.inverse());
  return poses;
}

std::vector<Rigid3> given_poses(const FrameBuffer& frames) {
  std::vector<Rigid3> poses;
  for (const SurveyFrame& frame : frames.all()) poses.push_back(frame.given.world_from_camera);
  return poses;
}

TEST(CamerasAround, follow_the_motions_where_poses_jitter) {
  FrameBuffer frames =
      noisy_drive({.given_m = 0.04, .given_rad = 5e-4, .motion_m = 0.002, .motion_rad = 2e-5});
  SurveyFrame& middle = frames[KeyframeId{30}];
  middle.world_from_camera = smoothed_pose(frames, {30}, kReach);
  middle.camera_from_world = middle.world_from_camera.inverse();
  EXPECT_LT(relative_error_m(around_frame_30(frames)), 0.25 * relative_error_m(given_poses(frames)));
}

TEST(CamerasAround, are_the_given_ones_where_these_are_exact) {
  const FrameBuffer frames = noisy_drive({.motion_m = 0.02, .motion_rad = 0.001});
  std::vector<Rigid3> led(kFrames);  // by the motions alone
  led[30] = testkit::on_bend(30);
  for (std::size_t i = 31; i < kFrames; ++i)
    led[i] = led[i - 1] * frames[KeyframeId{static_cast<std::int32_t>(i)}].motion->previous_from_this;
  for (std::size_t i = 30; i-- > 0;)
    led[i] = led[i + 1] *
             frames[KeyframeId{static_cast<std::int32_t>(i) + 1}].motion->previous_from_this.inverse();
  EXPECT_LT(relative_error_m(around_frame_30(frames)), 0.3 * relative_error_m(led));
}

TEST(CamerasAround, are_as_they_were_without_motions) {
  FrameBuffer frames = noisy_drive({.given_m = 0.04});
  for (int i = 0; i < kFrames; ++i) frames[KeyframeId{i}].motion.reset();
  const auto cameras = cameras_around(frames, {30}, kReach);
  ASSERT_EQ(std::ssize(cameras), kFrames);
  for (int i = 0; i < kFrames; ++i)
    EXPECT_EQ(distance(cameras[static_cast<std::size_t>(i)], frames[KeyframeId{i}].camera_from_world), 0);
}

TEST(CamerasAround, are_those_of_a_buffer_that_begins_later) {
  FrameBuffer frames = noisy_drive({.given_m = 0.04, .motion_m = 0.002});
  for (int i = 0; i < 20; ++i) frames.pop_front();
  const auto cameras = cameras_around(frames, {30}, kReach);
  ASSERT_EQ(std::ssize(cameras), kFrames - 20);
  EXPECT_EQ(distance(cameras[10], frames[KeyframeId{30}].camera_from_world), 0);
}

/// Tracks of points in one frame, and the next one, whose odometry is 5 cm and 3 mrad wrong.
class MeasureMotion : public testing::Test {
 protected:
  void make(std::size_t points, double noise_px) {
    const auto world = testkit::roadside_points(points);
    frames_ = testkit::drive(world, 1, noise_px);
    next_ = testkit::see(world, 1, testkit::on_bend(1), noise_px);
    const Rigid3 wrong{rotation_exp({0, 0.003, 0}), {0.03, 0, 0.04}};
    next_.odometry = WorldFromCamera(next_.odometry * wrong);
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(points); ++i) {
      tracks_.push_back(testkit::track_of(frames_, i, 0, 0));
      tracks_.back().point_in_world = world[static_cast<std::size_t>(i)].position;
      matches_.push_back({i, i});
    }
  }
  [[nodiscard]] std::optional<VisualMotion> measure() const {
    return measure_motion(kDriveRig, frames_, tracks_, next_, matches_);
  }
  /// As wrong matches have it.
  void mislead(std::size_t count) {
    Random random(9);
    for (std::size_t i = 0; i < count; ++i) {
      next_.observed.observations[i].u += random.uniform(-40, 40);
      next_.observed.observations[i].v += random.uniform(-40, 40);
    }
  }
  static Rigid3 truth() { return testkit::on_bend(0).inverse() * Rigid3(testkit::on_bend(1)); }

  FrameBuffer frames_;
  std::vector<Track> tracks_;
  std::vector<TrackMatch> matches_;
  SurveyFrame next_;
};

TEST_F(MeasureMotion, finds_it_from_a_rough_guess) {
  make(200, 0);
  const auto motion = measure();
  ASSERT_TRUE(motion.has_value());
  EXPECT_LT(distance(motion->previous_from_this, truth()), 1e-5);
  EXPECT_LT(angle_between(motion->previous_from_this, truth()), 1e-6);
}

TEST_F(MeasureMotion, says_how_sure_it_is) {
  make(200, 0.5);
  const auto motion = measure();
  ASSERT_TRUE(motion.has_value());
  const double error = distance(motion->previous_from_this, truth());
  EXPECT_LT(error, 4 * std::sqrt(3 * motion->translation_variance));
  EXPECT_GT(error, 0.1 * std::sqrt(motion->translation_variance));
  EXPECT_LT(angle_between(motion->previous_from_this, truth()), 4 * std::sqrt(3 * motion->rotation_variance));
}

TEST_F(MeasureMotion, stands_wrong_matches) {
  make(200, 0);
  mislead(60);
  const auto motion = measure();
  ASSERT_TRUE(motion.has_value());
  EXPECT_LT(distance(motion->previous_from_this, truth()), 0.01);
}

TEST_F(MeasureMotion, is_nothing_where_few_agree) {
  make(200, 0);
  mislead(150);
  EXPECT_FALSE(measure().has_value());
}

TEST_F(MeasureMotion, is_nothing_from_a_few_matches) {
  make(30, 0);
  EXPECT_TRUE(measure().has_value());
  matches_.pop_back();
  EXPECT_FALSE(measure().has_value());
}

TEST_F(MeasureMotion, is_nothing_of_the_first_frame) {
  make(200, 0);
  frames_ = {};
  EXPECT_FALSE(measure().has_value());
}

}  // namespace
}  // namespace cairn
