// SPDX-License-Identifier: Apache-2.0
#include "cairn/survey/pose_adjustment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "cairn/core/random.h"
#include "cairn/testing/geometry/camera_paths.h"
#include "cairn/testing/survey/point_drive.h"

namespace cairn {
namespace {

using testkit::kDriveRig;

constexpr int kFrames = 15;  // all of them see all points
constexpr std::int32_t kPoints = 150;

/// A perturbation of that size per axis, of the rotation about the centre and of the centre.
Rigid3 perturbed(const Rigid3& pose, double radians, double metres, Random& random) {
  Vector6d xi;
  for (Eigen::Index i = 0; i < 6; ++i) xi[i] = (i < 3 ? radians : metres) * random.normal();
  const Rigid3 moved = perturb_left(xi, Rigid3{pose.rotation, Eigen::Vector3d::Zero()});
  return {moved.rotation, pose.translation + moved.translation};
}

double distance(const Rigid3& a, const Rigid3& b) {
  return (a.translation - b.translation).norm();
}

double angle_between(const Rigid3& a, const Rigid3& b) {
  return rotation_angle(a.rotation.conjugate() * b.rotation);
}

/// A drive past points; on_bend is the truth of its poses.
class Drive {
 public:
  /// Poses with errors of that size per axis; motions as the images have them, `motion_scale` times as long,
  /// with errors of `motion_m`.
  Drive(double given_m, double given_rad, double motion_scale = 1, double motion_m = 1e-3) {
    Random random(3);
    const auto points = testkit::roadside_points(kPoints);
    for (int i = 0; i < kFrames; ++i) {
      SurveyFrame frame = testkit::see(points, i, testkit::on_bend(i), 0.2);
      give(frame, WorldFromCamera(perturbed(testkit::on_bend(i), given_rad, given_m, random)));
      if (i > 0) {
        Rigid3 step = testkit::on_bend(i - 1).inverse() * Rigid3(testkit::on_bend(i));
        step.translation *= motion_scale;
        frame.motion = VisualMotion{perturbed(step, 1e-5, motion_m, random), 1e-10, 1e-6};
        frame.odometry = WorldFromCamera(frames_.back().odometry * frame.motion->previous_from_this);
      }
      frames_.push_back(std::move(frame));
    }
    for (std::int32_t i = 0; i < kPoints; ++i)
      tracks_.push_back(testkit::track_of(frames_, i, i % 3, kFrames - 1 - i % 4));
  }

  void adjust(KeyframeId first = {0}, int threads = 1, const Rig& rig = kDriveRig) {
    std::vector<const Track*> tracks;
    for (const Track& track : tracks_) tracks.push_back(&track);
    adjust_poses(rig, tracks, first, 20, Executor(threads), frames_);
  }

  static void give(SurveyFrame& frame, const WorldFromCamera& pose) {
    frame.given.world_from_camera = frame.world_from_camera = pose;
    frame.camera_from_world = pose.inverse();
  }

  /// Root mean squares over the frames.
  struct Errors {
    double given_m = 0, given_rad = 0, adjusted_m = 0, adjusted_rad = 0;
  };
  [[nodiscard]] Errors errors() const {
    Errors sums;
    for (const SurveyFrame& frame : frames_.all()) {
      const WorldFromCamera truth = testkit::on_bend(frame.id.value);
      sums.given_m += std::pow(distance(frame.given.world_from_camera, truth), 2) / kFrames;
      sums.given_rad += std::pow(angle_between(frame.given.world_from_camera, truth), 2) / kFrames;
      sums.adjusted_m += std::pow(distance(frame.world_from_camera, truth), 2) / kFrames;
      sums.adjusted_rad += std::pow(angle_between(frame.world_from_camera, truth), 2) / kFrames;
    }
    return {std::sqrt(sums.given_m), std::sqrt(sums.given_rad), std::sqrt(sums.adjusted_m),
            std::sqrt(sums.adjusted_rad)};
  }
  /// Returns how far poses are from the given ones at most, metres.
  [[nodiscard]] double largest_move() const {
    double largest = 0;
    for (const SurveyFrame& frame : frames_.all())
      largest = std::max(largest, distance(frame.world_from_camera, frame.given.world_from_camera));
    return largest;
  }
  /// Returns the root mean square of what steps from frame to frame differ by from true ones, metres.
  [[nodiscard]] double error_of_steps() const {
    double squares = 0;
    for (int i = 1; i < kFrames; ++i) {
      const Rigid3 step = frames_[KeyframeId{i}].world_from_camera.inverse() *
                          Rigid3(frames_[KeyframeId{i - 1}].world_from_camera);
      squares += std::pow(distance(step, testkit::on_bend(i).inverse() * Rigid3(testkit::on_bend(i - 1))), 2);
    }
    return std::sqrt(squares / (kFrames - 1));
  }
  /// Lets the errors of the given centres wander, by `step_m` per axis from frame to frame.
  void let_wander(double step_m) {
    Random random(6);
    Eigen::Vector3d error = Eigen::Vector3d::Zero();
    for (int i = 0; i < kFrames; ++i) {
      SurveyFrame& frame = frames_[KeyframeId{i}];
      for (Eigen::Index axis = 0; axis < 3; ++axis) error[axis] += step_m * random.normal();
      const Rigid3& pose = frame.given.world_from_camera;
      give(frame, WorldFromCamera(Rigid3{pose.rotation, pose.translation + error}));
    }
  }
  /// Lets all given poses state these deviations per axis.
  void state(double metres, double radians) {
    for (int i = 0; i < kFrames; ++i) {
      GivenPose& given = frames_[KeyframeId{i}].given;
      given.uncertainty.emplace();
      given.uncertainty->position = metres * metres * Eigen::Matrix3d::Identity();
      given.uncertainty->rotation = radians * radians * Eigen::Matrix3d::Identity();
    }
  }
  FrameBuffer& frames() { return frames_; }
  std::vector<Track>& tracks() { return tracks_; }

 private:
  FrameBuffer frames_;
  std::vector<Track> tracks_;
};

TEST(AdjustPoses, exact_poses_stay) {
  Drive drive(0, 0);
  drive.adjust();
  EXPECT_LT(drive.errors().adjusted_m, 0.001);
  EXPECT_LT(drive.errors().adjusted_rad, 2e-5);
}

TEST(AdjustPoses, jitter_is_averaged_out) {
  Drive drive(0.04, 5e-4);
  drive.adjust();
  const auto errors = drive.errors();
  EXPECT_NEAR(errors.given_m, 0.04 * std::sqrt(3.0), 0.02);
  EXPECT_LT(errors.adjusted_m, errors.given_m / 2.5);
  EXPECT_LT(errors.adjusted_rad, errors.given_rad / 1.2);
}

TEST(AdjustPoses, keeps_the_place_that_is_given) {
  Drive drive(0, 0);
  const Rigid3 offset{rotation_exp({0.02, -0.5, 0.01}), {10, -2, 300}};
  for (int i = 0; i < kFrames; ++i) {
    SurveyFrame& frame = drive.frames()[KeyframeId{i}];
    Drive::give(frame, WorldFromCamera(offset * frame.given.world_from_camera));
  }
  drive.adjust();
  EXPECT_LT(drive.largest_move(), 0.001);
}

TEST(AdjustPoses, motions_that_are_all_too_short_do_not_move_exact_poses) {
  Drive drive(0, 0, 0.9);
  Rig wide = kDriveRig;
  wide.baseline *= 0.9;  // all that the images show is nearer
  drive.adjust({0}, 1, wide);
  EXPECT_LT(drive.largest_move(), 0.01);
}

TEST(AdjustPoses, takes_the_way_of_the_images_where_poses_may_wander) {
  Drive unstated(0, 0), stated(0, 0);
  for (Drive* drive : {&unstated, &stated}) drive->let_wander(0.01);
  const double given = stated.error_of_steps();
  stated.state(0.2, 1e-3);
  for (Drive* drive : {&unstated, &stated}) drive->adjust();
  EXPECT_LT(stated.error_of_steps(), given / 2);
  EXPECT_LT(stated.error_of_steps(), 0.75 * unstated.error_of_steps());
  EXPECT_LT(stated.largest_move(), 0.1);
  EXPECT_LT(stated.errors().adjusted_rad, 5e-4);
}

TEST(AdjustPoses, motions_that_are_all_too_short_move_poses_by_less_than_these_state) {
  Drive drive(0, 0, 0.98);
  drive.state(0.05, 1e-3);
  Rig wide = kDriveRig;
  wide.baseline *= 0.98;
  drive.adjust({0}, 1, wide);
  EXPECT_LT(drive.largest_move(), 0.06);
  EXPECT_LT(drive.errors().adjusted_rad, 5e-4);
}

TEST(AdjustPoses, wrong_observations_do_not_count) {
  Drive drive(0, 0);
  Random random(5);
  for (std::int32_t i = 0; i < kPoints; i += 5) {
    for (int k = 0; k < kFrames; k += 2) {
      Observation& seen = drive.frames()[KeyframeId{k}].observed.observations[static_cast<std::size_t>(i)];
      seen.u += random.uniform(20, 60);
    }
  }
  drive.adjust();
  EXPECT_LT(drive.errors().adjusted_m, 0.005);
}

TEST(AdjustPoses, keeps_frames_before_the_first) {
  Drive drive(0.04, 5e-4);
  const auto poses_before = drive.frames().camera_poses();
  drive.adjust({6});
  const auto poses_after = drive.frames().camera_poses();
  for (std::size_t i = 0; i < kFrames; ++i) {
    const double moved = distance(poses_before[i], poses_after[i]);
    if (i < 6)
      EXPECT_EQ(moved, 0);
    else
      EXPECT_GT(moved, 1e-4);
  }
}

TEST(AdjustPoses, without_tracks_poses_stay_as_given) {
  Drive drive(0.04, 5e-4);
  drive.tracks().clear();
  drive.adjust();
  EXPECT_EQ(drive.largest_move(), 0);
}

TEST(AdjustPoses, without_motions_poses_stay_as_given) {
  Drive drive(0.04, 5e-4);
  for (int i = 0; i < kFrames; ++i) drive.frames()[KeyframeId{i}].motion.reset();
  drive.adjust();
  EXPECT_LT(drive.largest_move(), 0.001);
}

TEST(AdjustPoses, is_the_same_at_any_number_of_threads) {
  Drive one(0.04, 5e-4), three(0.04, 5e-4);
  one.adjust({0}, 1);
  three.adjust({0}, 3);
  for (int i = 0; i < kFrames; ++i) {
    const auto &a = one.frames()[KeyframeId{i}].world_from_camera,
               &b = three.frames()[KeyframeId{i}].world_from_camera;
    EXPECT_EQ(a.translation, b.translation);
    EXPECT_EQ(a.rotation.coeffs(), b.rotation.coeffs());
  }
}

TEST(MeasureNoise, tells_jitter_of_poses_from_drift_of_motions) {
  Drive jitter(0.04, 5e-4), drift(0, 0, 1, 0.04), scale(0, 0, 0.9);
  const auto noise_of = [](Drive& drive) { return measure_noise(drive.frames(), {0}, {kFrames - 1}); };
  const PoseNoise of_poses = noise_of(jitter), of_motions = noise_of(drift), of_scale = noise_of(scale);
  for (Eigen::Index i = 3; i < 6; ++i) {
    EXPECT_NEAR(std::sqrt(of_poses.given[i]), 0.04, 0.025);
    EXPECT_NEAR(std::sqrt(of_poses.formal[i]), 1e-3, 1e-9);
    EXPECT_LT(of_poses.motion[i], 0.2 * of_poses.given[i]);
    EXPECT_LT(std::sqrt(of_scale.given[i]), 0.003);
  }
  EXPECT_GT(of_motions.motion.tail<3>().sum(), of_poses.motion.tail<3>().sum());
  EXPECT_LT(of_motions.given.tail<3>().sum(), of_poses.given.tail<3>().sum());
}

TEST(MeasureNoise, takes_stated_deviations_for_jitter_as_far_as_poses_jitter) {
  Drive jitter(0.04, 5e-4), wander(0, 0);
  wander.let_wander(0.01);
  const auto noise_of = [](Drive& drive) { return measure_noise(drive.frames(), {0}, {kFrames - 1}); };
  const PoseNoise unstated = noise_of(jitter);
  jitter.state(0.01, 1e-4);
  EXPECT_EQ(noise_of(jitter).given, unstated.given);
  const double before = noise_of(wander).given[5];
  wander.state(0.5, 1e-2);
  EXPECT_GT(noise_of(wander).given[5], 10 * before);
}

TEST(MoveInSigmas, counts_in_the_direction_of_the_move) {
  GivenPose given;
  given.world_from_camera = testkit::on_bend(3);
  given.uncertainty.emplace();
  given.uncertainty->position = Eigen::Vector3d(0.01, 0.04, 0).asDiagonal();
  given.uncertainty->rotation = Eigen::Vector3d(1e-6, 4e-6, 9e-6).asDiagonal();
  const auto moved = [&](const Eigen::Vector3d& move, const Eigen::Vector3d& turn) {
    const Rigid3& pose = given.world_from_camera;
    return move_in_sigmas(
        given, WorldFromCamera(Rigid3{rotation_exp(turn) * pose.rotation, pose.translation + move}));
  };
  const Eigen::Vector3d none = Eigen::Vector3d::Zero();
  EXPECT_NEAR(moved({0.3, 0, 0}, {0, 4e-3, 0}).position, 3, 1e-9);
  EXPECT_NEAR(moved({0.3, 0, 0}, {0, 4e-3, 0}).rotation, 2, 1e-6);
  EXPECT_NEAR(moved({0.3, 0.3, 0}, none).position, 0.3 * std::sqrt(2) / std::sqrt(0.025), 1e-9);
  EXPECT_EQ(moved(none, none).position, 0);
  EXPECT_TRUE(std::isinf(moved({0, 0, 1e-3}, none).position));  // stated as exact
  given.uncertainty->rotation.setZero();
  EXPECT_TRUE(std::isnan(moved(none, {0, 4e-3, 0}).rotation));  // nothing is stated
  EXPECT_NEAR(moved({0.3, 0, 0}, none).position, 3, 1e-9);
}

TEST(MoveInSigmas, has_median_and_largest) {
  EXPECT_EQ(summarise_moves({}).frames, 0);
  const MoveInSigmas moves[] = {{3, 0.1}, {1, 0.5}, {2, 0.2}};
  const MovesInSigmas summary = summarise_moves(moves);
  EXPECT_EQ(summary.frames, 3);
  EXPECT_EQ(summary.median.position, 2);
  EXPECT_EQ(summary.largest.position, 3);
  EXPECT_EQ(summary.median.rotation, 0.2);
  EXPECT_EQ(summary.largest.rotation, 0.5);
  const double none = std::numeric_limits<double>::quiet_NaN();
  const MoveInSigmas of_some[] = {{3, none}, {none, none}, {2, none}};
  EXPECT_EQ(summarise_moves(of_some).largest.position, 3);
  EXPECT_TRUE(std::isnan(summarise_moves(of_some).median.rotation));
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
