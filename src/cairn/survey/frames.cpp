// SPDX-License-Identifier: Apache-2.0
#include "cairn/survey/frames.h"

#include <utility>

#include "cairn/core/error.h"

namespace cairn {

SurveyFrame make_frame(KeyframeId id, ObservedFrame observed, const GivenPose& given, double sigma_px) {
  SurveyFrame frame;
  frame.id = id;
  frame.observed = std::move(observed);
  scale_sigmas(sigma_px, frame.observed);
  frame.given = given;
  frame.world_from_camera = frame.odometry = given.world_from_camera;
  frame.camera_from_world = given.world_from_camera.inverse();
  return frame;
}

Matrix6d stated_covariance(const GivenPose& given) {
  Matrix6d covariance = Matrix6d::Zero();
  if (!given.uncertainty) return covariance;
  const PoseUncertainty& stated = *given.uncertainty;
  covariance << stated.rotation, stated.position_rotation.transpose(), stated.position_rotation,
      stated.position;
  Matrix6d camera_from_world = Matrix6d::Zero();
  camera_from_world.topLeftCorner<3, 3>() = camera_from_world.bottomRightCorner<3, 3>() =
      given.world_from_camera.matrix3().transpose();
  return camera_from_world * covariance * camera_from_world.transpose();
}

Vector6d least_variances() {
  return (Vector6d() << 1e-12, 1e-12, 1e-12, 1e-10, 1e-10, 1e-10).finished();
}

void FrameBuffer::push_back(SurveyFrame&& frame) {
  require(frames_.empty() || frame.id.value == frames_.back().id.value + 1, "frames come in their order");
  frames_.push_back(std::move(frame));
}

std::size_t FrameBuffer::position(KeyframeId id) const {
  require(!frames_.empty() && id >= frames_.front().id && id <= frames_.back().id,
          "the frame is in the buffer");
  return static_cast<std::size_t>(id.value - frames_.front().id.value);
}

std::vector<CameraFromWorld> FrameBuffer::camera_poses() const {
  std::vector<CameraFromWorld> poses;
  poses.reserve(frames_.size());
  for (const SurveyFrame& frame : frames_) poses.push_back(frame.camera_from_world);
  return poses;
}

const Observation& observation_of(const FrameBuffer& frames, const ObservationRef& observation) {
  return frames[observation.keyframe].observed.observations[static_cast<std::size_t>(observation.feature)];
}

const Keypoint& keypoint_of(const FrameBuffer& frames, const ObservationRef& observation) {
  return frames[observation.keyframe]
      .observed.features.keypoints[static_cast<std::size_t>(observation.feature)];
}

Appearance appearance_of(const FrameBuffer& frames, const ObservationRef& observation) {
  const SurveyFrame& frame = frames[observation.keyframe];
  return {&frame.observed.features.descriptors, static_cast<std::size_t>(observation.feature),
          keypoint_of(frames, observation), frame.odometry.translation};
}

ObservedFrame select(const ObservedFrame& observed, std::span<const std::uint32_t> features) {
  ObservedFrame some{observed.frame, observed.stamp_ns, {}, {}, {}};
  for (const std::uint32_t i : features) {
    some.features.keypoints.push_back(observed.features.keypoints[i]);
    some.observations.push_back(observed.observations[i]);
    some.points_in_camera.push_back(observed.points_in_camera[i]);
  }
  const std::vector<std::size_t> rows(features.begin(), features.end());
  some.features.descriptors = select(observed.features.descriptors, rows);
  return some;
}

void scale_sigmas(double factor, ObservedFrame& observed) {
  for (Observation& seen : observed.observations) seen.sigma_px *= factor;
}

}  // namespace cairn
