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
#include "cairn/simulate/scene.h"
#include "cairn/simulate/sensor_noise.h"

namespace cairn {

/// A Kinect's colour camera, 640x480.
[[nodiscard]] Camera simulated_rgbd_camera();
/// The camera with `factor` times the pixels along each side and the same field of view.
[[nodiscard]] Camera resized(const Camera& camera, double factor);

/// kinect: noise, quantisation and holes of a Kinect v1, noisy images of varying gain. none: exact.
enum class RgbdNoise { kinect, none };

struct SimulateRoomOptions {
  int frames_count = 300;
  double rate_hz = 30;  ///< frames a second
  double speed = 0.4;   ///< metres a second; slower where the room is too small for it
  int loops = 0;        ///< times around; 0: as many as the length needs, a part of one below 8 seconds
  Camera camera = simulated_rgbd_camera();  ///< pinhole; depth is seen by the same camera
  double depth_scale = 5000;                ///< stored units per metre, as the TUM benchmark has it
  RgbdNoise noise = RgbdNoise::kinect;
  float image_deviation = 2;  ///< of the image noise, grey levels; none with RgbdNoise::none
  std::uint64_t seed = 1;     ///< of the textures and all noise

  /// InputError, naming the option of the command line, for what no camera could have.
  void validate() const;
};

struct SimulatedRgbdFrame {
  RgbImage color;
  DepthImage depth_true;  ///< metres, exact to the float
  RawDepthImage depth;    ///< as the sensor stores it
};

/// A furnished room seen by an RGB-D camera on a closed walk, with exact truth, without touching a disk.
/// Fewer frames than 8 seconds hold are a part of a walk, unless `loops` is given: then they are all of it,
/// at a hurry.
/// The same bytes from the same options, on any thread. z of the world is up, its origin a corner of the
/// floor.
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
  /// Safe to call from several threads.
  [[nodiscard]] SimulatedRgbdFrame render(int frame) const;

 private:
  SimulateRoomOptions options_;
  double share_per_frame_;  // of the closed walk
  RoomPath path_;
  Scene scene_;
};

}  // namespace cairn
