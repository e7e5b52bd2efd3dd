// SPDX-License-Identifier: Apache-2.0
#include "cairn/simulate/simulate_room.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "cairn/core/error.h"
#include "cairn/simulate/room_scene.h"

namespace cairn {
namespace {

void expect(bool holds, const char* option, const char* expected, double found) {
  if (holds) return;
  throw InputError({option, 0, expected, fmt::format("{}", found), "Choose another value."});
}

/// Texture pixels about as large as a pixel sees them from two metres.
double texel_for(const Camera& camera) {
  return 2.0 / camera.fx;
}

/// Seconds of the whole closed walk. Where the number of loops is left open, a loop is not walked in less
/// than it takes a person to turn around at ease.
double walk_duration(const SimulateRoomOptions& options) {
  constexpr double kMinLoop = 8;
  const double duration = options.frames_count / options.rate_hz;
  return options.loops > 0 ? duration : std::max(duration, kMinLoop);
}

RoomPath path_for(const SimulateRoomOptions& options) {
  RoomPath::Shape shape;
  shape.center.head<2>() = kRoomSize.head<2>() / 2;
  shape.duration = walk_duration(options);
  shape.length = options.speed * shape.duration;
  const double longest_loop = 2 * std::numbers::pi * shape.max_radius;
  const int needed = std::max(1, static_cast<int>(std::ceil(shape.length / longest_loop)));
  shape.loops = options.loops > 0 ? options.loops : needed;
  return RoomPath(shape);
}

const SimulateRoomOptions& validated(const SimulateRoomOptions& options) {
  options.validate();
  return options;
}

}  // namespace

Camera simulated_rgbd_camera() {
  Camera camera;
  camera.width = 640;
  camera.height = 480;
  camera.fx = camera.fy = 525.0;
  camera.cx = 319.5;
  camera.cy = 239.5;
  return camera;
}

Camera resized(const Camera& camera, double factor) {
  require(factor > 0, "a camera is resized by a factor above 0");
  Camera result = camera;
  result.width = static_cast<int>(std::lround(camera.width * factor));
  result.height = static_cast<int>(std::lround(camera.height * factor));
  result.fx = camera.fx * factor;
  result.fy = camera.fy * factor;
  result.cx = (camera.cx + 0.5) * factor - 0.5;
  result.cy = (camera.cy + 0.5) * factor - 0.5;
  return result;
}

void SimulateRoomOptions::validate() const {
  expect(frames_count >= 1 && frames_count <= 1'000'000, "--frames-count", "1 to 1000000 frames",
         frames_count);
  expect(rate_hz > 0 && rate_hz <= 1e6, "rate_hz", "a rate above 0", rate_hz);
  expect(speed > 0 && speed <= 100, "--speed", "a speed above 0 m/s", speed);
  expect(loops >= 0, "--loops", "0 (automatic) or more", loops);
  expect(camera.model == CameraModel::pinhole && camera.width > 0 && camera.height > 0 && camera.fx > 0 &&
             camera.fy > 0,
         "camera", "a pinhole camera with pixels and focal lengths", camera.fx);
  expect(depth_scale > 0, "depth_scale", "units per metre above 0", depth_scale);
  expect(depth_noise >= 0 && depth_noise <= 100, "--depth-noise", "0 to 100 times a Kinect's", depth_noise);
  pose_error.validate();
  expect(image_deviation >= 0, "image_deviation", "0 or more grey levels", image_deviation);
}

SimulatedRoom::SimulatedRoom(const SimulateRoomOptions& options, const Executor& executor)
    : options_(validated(options)),
      share_per_frame_(1 / (walk_duration(options) * options.rate_hz)),
      path_(path_for(options)),
      scene_(furnished_room(texel_for(options.camera), options.seed).build(executor)) {}

Calibration SimulatedRoom::calibration() const {
  Calibration calibration;
  calibration.camera = options_.camera;
  calibration.depth.emplace();
  calibration.depth->scale = options_.depth_scale;
  return calibration;
}

std::int64_t SimulatedRoom::stamp_ns(int frame) const {
  return std::llround(frame * 1e9 / options_.rate_hz);
}

WorldFromCamera SimulatedRoom::world_from_camera(int frame) const {
  require(frame >= 0 && frame < size(), "a frame of the sequence");
  return path_.world_from_camera(frame * share_per_frame_);
}

Trajectory SimulatedRoom::truth() const {
  Trajectory truth;
  for (int i = 0; i < size(); ++i) truth.push_back({stamp_ns(i), world_from_camera(i)});
  return truth;
}

StampedPoses SimulatedRoom::given_poses() const {
  return with_pose_errors(options_.pose_error, stamped_poses(truth()), options_.seed);
}

SimulatedRgbdFrame SimulatedRoom::render(int frame) const {
  SceneImage seen = render_scene(scene_, options_.camera, world_from_camera(frame));
  SimulatedRgbdFrame result;
  result.depth_true = std::move(seen.depth);
  ImageSensor sensor;
  if (options_.noise == RgbdNoise::none) {
    result.color = expose_rgb(seen.light, sensor);
    result.depth = store_depth(result.depth_true, options_.depth_scale);
    return result;
  }
  sensor.seed = options_.seed;
  sensor.frame = static_cast<std::uint64_t>(frame);
  sensor.deviation = options_.image_deviation;
  const auto share = static_cast<float>(2 * std::numbers::pi * frame * share_per_frame_);
  sensor.gain = (1 + 0.05F * std::sin(3 * share)) *
                Color(1 + 0.02F * std::sin(2 * share), 1, 1 + 0.02F * std::cos(5 * share));
  DepthSensor depth_sensor;
  depth_sensor.seed = options_.seed;
  depth_sensor.frame = sensor.frame;
  depth_sensor.noise_factor = options_.depth_noise;
  result.color = expose_rgb(seen.light, sensor);
  result.depth = sense_depth(result.depth_true, options_.camera, options_.depth_scale, depth_sensor);
  return result;
}

}  // namespace cairn
