// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "cairn/core/executor.h"
#include "cairn/geometry/camera.h"
#include "cairn/geometry/rigid3.h"
#include "cairn/image/image.h"
#include "cairn/sequence/calibration.h"
#include "cairn/sequence/trajectory.h"
#include "cairn/simulate/camera_path.h"
#include "cairn/simulate/pose_error.h"
#include "cairn/simulate/scene.h"
#include "cairn/simulate/sensor_noise.h"

namespace cairn {

/// Returns a Kinect's colour camera, 640x480.
[[nodiscard]] Camera simulated_rgbd_camera();
/// Returns the camera with `factor` times the pixels along each side and the same field of view. Throws
/// PreconditionError unless the factor is above 0.
[[nodiscard]] Camera resized(const Camera& camera, double factor);

/// Names the noise. kinect: noise, quantisation and holes of a Kinect v1, noisy images of varying gain. none:
/// exact.
enum class RgbdNoise { kinect, none };

/// Sets the walk, the camera and the noise.
struct SimulateRoomOptions {
  int frames_count = 300;
  double rate_hz = 30;  ///< frames per second
  double speed = 0.4;   ///< metres per second; slower if the room is too small for it
  int loops = 0;        ///< times around; 0: as many as the length needs, a part of one below 8 seconds
  Camera camera = simulated_rgbd_camera();  ///< pinhole; depth is seen by the same camera
  double depth_scale = 5000;                ///< stored units per metre, as the TUM benchmark has it
  RgbdNoise noise = RgbdNoise::kinect;
  /// Standard deviation of the image noise, grey levels; none with RgbdNoise::none.
  float image_deviation = 2;
  double depth_noise = 1;  ///< standard deviation of the depth, times a Kinect's; none with RgbdNoise::none
  PoseErrorOptions pose_error;  ///< of given poses; the truth has none
  std::uint64_t seed = 1;       ///< determines the textures and all noise

  /// Throws InputError that names the option of the command line if no camera could have the value.
  void validate() const;
};

/// Holds the images of one frame.
struct SimulatedRgbdFrame {
  RgbImage color;
  DepthImage depth_true;  ///< metres, exact to the float
  RawDepthImage depth;    ///< as the sensor stores it
};

/// Simulates a furnished room seen by an RGB-D camera on a closed walk, with exact truth, without touching a
/// disk. Fewer frames than 8 seconds hold are a part of a walk, unless `loops` is given: then they are all of
/// it, in a hurry. Gives the same bytes from the same options, on any thread. z of the world is up, its
/// origin a corner of the floor.
class SimulatedRoom {
 public:
  /// Paints the room, which takes about a second for a 640x480 camera; less for a smaller one.
  explicit SimulatedRoom(const SimulateRoomOptions& options, const Executor& executor = Executor());

  [[nodiscard]] int size() const { return options_.frames_count; }
  [[nodiscard]] const Camera& camera() const { return options_.camera; }
  [[nodiscard]] Calibration calibration() const;
  [[nodiscard]] std::int64_t stamp_ns(int frame) const;
  [[nodiscard]] WorldFromCamera world_from_camera(int frame) const;
  [[nodiscard]] Trajectory truth() const;
  /// Returns the poses of the camera with the errors of SimulateRoomOptions::pose_error.
  [[nodiscard]] StampedPoses given_poses() const;
  [[nodiscard]] const PoseErrorOptions& pose_error() const { return options_.pose_error; }
  /// Renders a frame. Safe to call from several threads.
  [[nodiscard]] SimulatedRgbdFrame render(int frame) const;

 private:
  SimulateRoomOptions options_;
  double share_per_frame_;  // of the closed walk
  RoomPath path_;
  Scene scene_;
};

}  // namespace cairn
