// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "cairn/core/executor.h"
#include "cairn/geometry/camera.h"
#include "cairn/geometry/rigid3.h"
#include "cairn/image/image.h"
#include "cairn/sequence/calibration.h"
#include "cairn/sequence/trajectory.h"
#include "cairn/simulate/camera_path.h"
#include "cairn/simulate/pose_error.h"
#include "cairn/simulate/scene.h"

namespace cairn {

/// Returns the left camera of a car with a stereo rig, 1242x375, as KITTI's.
[[nodiscard]] Camera simulated_stereo_camera();

/// Names the noise. camera: noisy images of varying gain. none: exact.
enum class StreetNoise { camera, none };

/// Names the way. block: around a block, along its corners. straight: along one straight street, at constant
/// speed.
enum class StreetRoute { block, straight };

/// Describes the poses of the car's body (x forward, y left, z up) that are written beside the truth, and by
/// how much what is stated of them is wrong.
struct SimulatedBodyPoses {
  double rate_hz = 100;      ///< poses a second
  double time_offset_s = 0;  ///< has to be added to the written stamps to make them right; -10 to 10
  /// Lever arm of the camera less the stated one, metres in the body's axes; each at most 10 in magnitude.
  Eigen::Vector3d lever_arm_error = Eigen::Vector3d::Zero();
  /// Rotation vector in the body's axes, degrees, by which the camera is turned out of the stated boresight:
  /// true rotation = exp(this) * stated one; each at most 10 in magnitude.
  Eigen::Vector3d boresight_error_deg = Eigen::Vector3d::Zero();

  /// Throws InputError that names the option of the command line if a value is out of range.
  void validate() const;
};

/// Sets the drive, the cameras and the noise.
struct SimulateStreetOptions {
  int frames_count = 200;
  double rate_hz = 10;  ///< frames per second
  double speed = 8;     ///< metres per second, mean over a round
  int loops = 0;        ///< times around the block; 0: as many as keep a round below 400 m
  Camera camera = simulated_stereo_camera();  ///< pinhole; used for both cameras
  double baseline = 0.537;                    ///< metres, as the calibration states it
  /// Says how the right camera is turned out of the rectified pose that the calibration states: a rotation
  /// vector about its own axes (x right, y down, z forward), degrees, each at most 5 in magnitude. Near the
  /// principal point of the right image, with angles in radians: x > 0 turns the camera up and adds fy * x to
  /// rows; y > 0 turns it to the right, takes fx * y from columns and so adds fx * y to disparities; z > 0
  /// turns it clockwise, as seen from behind it, takes z * (u - cx) from rows and adds z * (v - cy) to
  /// columns.
  Eigen::Vector3d right_rotation_deg = Eigen::Vector3d::Zero();
  /// Makes the true baseline (1 + this / 100) times the stated one; -20 to 20. Above 0 true disparities are
  /// larger than the calibration expects.
  double baseline_error_percent = 0;
  StreetRoute route = StreetRoute::block;
  std::optional<SimulatedBodyPoses> body_poses;  ///< nullopt: none
  PoseErrorOptions pose_error;                   ///< of given poses; the truth has none
  StreetNoise noise = StreetNoise::camera;
  /// Standard deviation of the image noise, grey levels; none with StreetNoise::none.
  float image_deviation = 2;
  std::uint64_t seed = 1;  ///< determines the street, the textures and all noise

  /// Throws InputError that names the option of the command line if no car could have the value.
  void validate() const;
};

/// Holds the images of one frame.
struct SimulatedStereoFrame {
  GrayImage left, right;
  DepthImage depth_true;  ///< of the left camera, metres, exact to the float, 0 for the sky
};

/// Simulates a street around a block, driven with a rectified stereo camera, with exact truth, without
/// touching a disk. The drive ends where it began; the block is at least 100 m around, so that fewer frames
/// than a round needs (125 by default) make a part of it. Gives the same bytes from the same options, on any
/// thread. The world is the first left camera, as KITTI has it.
class SimulatedStreet {
 public:
  /// Paints the street, which takes a few seconds for the default camera; less for a smaller one.
  explicit SimulatedStreet(const SimulateStreetOptions& options, const Executor& executor = Executor());

  [[nodiscard]] int size() const { return options_.frames_count; }
  [[nodiscard]] const Camera& camera() const { return options_.camera; }
  /// Returns what the sequence's files state, which does not know the planted errors of the right camera.
  [[nodiscard]] Calibration calibration() const;
  /// Returns where the right camera truly is, with the planted errors.
  [[nodiscard]] Rigid3 left_from_right() const;
  [[nodiscard]] std::int64_t stamp_ns(int frame) const;
  /// Returns the pose of the left camera.
  [[nodiscard]] WorldFromCamera world_from_camera(int frame) const;
  [[nodiscard]] Trajectory truth() const;
  /// Returns the stated pose of the camera on the body, whose axes are x forward, y left, z up.
  [[nodiscard]] static Rigid3 stated_body_from_camera();
  /// Returns world_from_body with the stamps and errors of SimulateStreetOptions::body_poses, from stamp 0 to
  /// that of the last frame; empty without these.
  [[nodiscard]] StampedPoses body_poses() const;
  /// Returns what a receiver gives: body_poses() if there are any, else those of the camera, with the errors
  /// of SimulateStreetOptions::pose_error.
  [[nodiscard]] StampedPoses given_poses() const;
  [[nodiscard]] const PoseErrorOptions& pose_error() const { return options_.pose_error; }
  /// Renders a frame. Safe to call from several threads.
  [[nodiscard]] SimulatedStereoFrame render(int frame) const;

 private:
  [[nodiscard]] Rigid3 street_from_camera(double frame) const;

  SimulateStreetOptions options_;
  double rounds_;  // driven in all
  StreetPath path_;
  Scene scene_;
};

}  // namespace cairn
