// SPDX-License-Identifier: Apache-2.0
#include "cairn/simulate/simulate_street.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cairn/core/error.h"
#include "cairn/simulate/sensor_noise.h"
#include "cairn/simulate/street_scene.h"

namespace cairn {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kRadiansPerDegree = kTurn / 360;
constexpr double kMinRound = 100, kMaxRound = 400;  // metres

void expect(bool holds, const char* option, const char* expected, double found) {
  if (holds) return;
  throw InputError({option, 0, expected, fmt::format("{}", found), "Choose another value."});
}

const SimulateStreetOptions& validated(const SimulateStreetOptions& options) {
  options.validate();
  return options;
}

/// Metres of the whole drive.
double drive_length(const SimulateStreetOptions& options) {
  return options.speed * options.frames_count / options.rate_hz;
}

constexpr double kCorner = 24;  // metres at most

/// Returns a round whose long straights hold the whole drive; on them the car is up to a fifth faster than on
/// average.
double round_with_straight(const SimulateStreetOptions& options) {
  const double straight = 1.25 * drive_length(options) + 10;
  const double both = straight * (1 + 1 / StreetPath::Shape{}.aspect);  // a long and a short one
  return 2 * both + 4 * kCorner;
}

double round_length(const SimulateStreetOptions& options) {
  if (options.route == StreetRoute::straight) return round_with_straight(options);
  const double length = drive_length(options);
  const double loops = options.loops > 0 ? options.loops : std::ceil(length / kMaxRound);
  return std::max(kMinRound, length / loops);
}

StreetPath path_for(const SimulateStreetOptions& options) {
  StreetPath::Shape shape;
  shape.length = round_length(options);
  shape.corner_length = std::min(kCorner, 0.16 * shape.length);
  return StreetPath(shape);
}

/// Texture pixels about as large as a pixel sees them from twelve metres.
double texel_for(const Camera& camera) {
  return 12.0 / camera.fx;
}

}  // namespace

Camera simulated_stereo_camera() {
  Camera camera;
  camera.width = 1242;
  camera.height = 375;
  camera.fx = camera.fy = 721.5;
  camera.cx = 609.5;
  camera.cy = 172.5;
  return camera;
}

void SimulatedBodyPoses::validate() const {
  constexpr double kMost = 10;  // metres, degrees, seconds
  expect(rate_hz > 0 && rate_hz <= 1e4, "rate_hz", "a rate above 0, up to 10000 a second", rate_hz);
  expect(std::abs(time_offset_s) <= kMost, "--pose-time-offset", "seconds from -10 to 10", time_offset_s);
  for (const double length : lever_arm_error)
    expect(std::abs(length) <= kMost, "--lever-arm-error", "metres from -10 to 10", length);
  for (const double angle : boresight_error_deg)
    expect(std::abs(angle) <= kMost, "--boresight-error", "angles from -10 to 10 degrees", angle);
}

void SimulateStreetOptions::validate() const {
  expect(frames_count >= 1 && frames_count <= 1'000'000, "--frames-count", "1 to 1000000 frames",
         frames_count);
  expect(rate_hz > 0 && rate_hz <= 1e6, "rate_hz", "a rate above 0", rate_hz);
  expect(speed > 0 && speed <= 100, "--speed", "a speed above 0 and up to 100 m/s", speed);
  expect(loops >= 0, "--loops", "0 (automatic) or more", loops);
  expect(loops == 0 || drive_length(*this) / loops <= 5000, "--loops", "rounds of at most 5000 m", loops);
  expect(camera.model == CameraModel::pinhole && camera.width > 0 && camera.height > 0 && camera.fx > 0 &&
             camera.fy > 0,
         "camera", "a pinhole camera with pixels and focal lengths", camera.fx);
  expect(baseline > 0, "--baseline", "a baseline above 0 m", baseline);
  for (const double angle : right_rotation_deg)
    expect(std::abs(angle) <= 5, "--right-rotation", "angles from -5 to 5 degrees", angle);
  expect(std::abs(baseline_error_percent) <= 20, "--baseline-error", "an error from -20 to 20 %",
         baseline_error_percent);
  expect(route == StreetRoute::block || loops == 0, "--loops", "0 on a straight street", loops);
  expect(route == StreetRoute::block || drive_length(*this) <= 1000, "--frames-count",
         "at most 1000 m on a straight street", frames_count);
  if (body_poses) body_poses->validate();
  pose_error.validate();
  expect(image_deviation >= 0, "image_deviation", "0 or more grey levels", image_deviation);
}

SimulatedStreet::SimulatedStreet(const SimulateStreetOptions& options, const Executor& executor)
    : options_(validated(options)),
      rounds_(drive_length(options) / round_length(options)),
      path_(path_for(options)),
      scene_(
          street_around_block(path_.half_extent(), texel_for(options.camera), options.seed).build(executor)) {
}

Calibration SimulatedStreet::calibration() const {
  Calibration calibration;
  calibration.camera = options_.camera;
  calibration.baseline = options_.baseline;
  if (options_.body_poses) calibration.body_from_camera = stated_body_from_camera();
  return calibration;
}

Rigid3 SimulatedStreet::left_from_right() const {
  const double baseline = options_.baseline * (1 + options_.baseline_error_percent / 100);
  return {rotation_exp(options_.right_rotation_deg * kRadiansPerDegree), {baseline, 0, 0}};
}

std::int64_t SimulatedStreet::stamp_ns(int frame) const {
  return std::llround(frame * 1e9 / options_.rate_hz);
}

Rigid3 SimulatedStreet::stated_body_from_camera() {
  return {Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5), {1.4, 0.3, 0.7}};
}

StampedPoses SimulatedStreet::body_poses() const {
  StampedPoses poses;
  if (!options_.body_poses) return poses;
  const SimulatedBodyPoses& errors = *options_.body_poses;
  const Rigid3 stated = stated_body_from_camera();
  const Rigid3 body_from_camera{
      rotation_exp(errors.boresight_error_deg * kRadiansPerDegree) * stated.rotation,
      stated.translation + errors.lever_arm_error};
  const Rigid3 world_from_street = street_from_camera(0).inverse();
  const double last = (size() - 1) / options_.rate_hz;  // seconds
  for (int i = 0; i <= std::floor(last * errors.rate_hz); ++i) {
    const double stamp = i / errors.rate_hz;
    const Rigid3 camera =
        world_from_street * street_from_camera((stamp + errors.time_offset_s) * options_.rate_hz);
    poses.emplace_back(std::llround(stamp * 1e9), camera * body_from_camera.inverse());
  }
  return poses;
}

StampedPoses SimulatedStreet::given_poses() const {
  return with_pose_errors(options_.pose_error, options_.body_poses ? body_poses() : stamped_poses(truth()),
                          options_.seed);
}

/// Returns the pose at a time in frames, which may lie between two of them.
Rigid3 SimulatedStreet::street_from_camera(double frame) const {
  const double share = frame / size();  // of the drive
  const double start = options_.route == StreetRoute::straight ? path_.start_of_straight() : 0;
  const double round = start + rounds_ * share;
  const StreetPath::PathPoint place = path_.at(round - std::floor(round));
  constexpr double kHeight = 1.65;
  const auto wave = [&](double periods_a_round, double phase) {
    return std::sin(kTurn * std::round(periods_a_round) * round + phase);
  };
  Rigid3 pose;  // the car rides on its springs
  pose.translation = {place.position.x(), place.position.y(),
                      kHeight + 0.01 * wave(17, 0) + 0.004 * wave(29, 1)};
  pose.rotation =
      world_from_looking(place.heading, 0.004 * wave(13, 2), 0.006 * wave(9, 0.5) + 0.002 * wave(31, 3));
  return pose;
}

WorldFromCamera SimulatedStreet::world_from_camera(int frame) const {
  require(frame >= 0 && frame < size(), "a frame of the sequence");
  return WorldFromCamera(street_from_camera(0).inverse() * street_from_camera(frame));
}

Trajectory SimulatedStreet::truth() const {
  Trajectory truth;
  for (int i = 0; i < size(); ++i) truth.push_back({stamp_ns(i), world_from_camera(i)});
  return truth;
}

SimulatedStereoFrame SimulatedStreet::render(int frame) const {
  const Rigid3 street_from_left = street_from_camera(frame);
  SceneImage seen_left = render_scene(scene_, options_.camera, street_from_left);
  const SceneImage seen_right = render_scene(scene_, options_.camera, street_from_left * left_from_right());
  ImageSensor sensor;
  sensor.seed = options_.seed;
  sensor.frame = 2 * static_cast<std::uint64_t>(frame);  // the right camera has streams of its own
  if (options_.noise == StreetNoise::camera) {
    sensor.deviation = options_.image_deviation;
    const auto share = static_cast<float>(kTurn * frame / size());
    sensor.gain = Color::Constant(1 + 0.06F * std::sin(3 * share));
  }
  SimulatedStereoFrame result;
  result.depth_true = std::move(seen_left.depth);
  result.left = expose_gray(seen_left.light, sensor);
  ++sensor.frame;
  result.right = expose_gray(seen_right.light, sensor);
  return result;
}

}  // namespace cairn
