// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "cairn/map/map.h"
#include "cairn/observe/prediction.h"
#include "cairn/sequence/given_poses.h"

namespace cairn {

/// How the camera moved since the frame before, as the images show it.
struct VisualMotion {
  Rigid3 previous_from_this;
  double rotation_variance = 0;     ///< per axis, radians squared
  double translation_variance = 0;  ///< per axis, square metres
};

/// A frame with its pose, as long as tracks need it.
struct SurveyFrame {
  KeyframeId id;
  ObservedFrame observed;           ///< the features that are of use
  std::vector<std::uint32_t> kept;  ///< which of all features of the image they are
  GivenPose given;
  WorldFromCamera world_from_camera;  ///< the given one, or what smoothed_pose made of it
  CameraFromWorld camera_from_world;  ///< its inverse
  /// In the world of the tracks: as the motion leads on from the frame before, or else the given poses. It
  /// drifts, but within a window it fits the images better than given poses do.
  WorldFromCamera odometry;
  std::optional<VisualMotion> motion;  ///< nothing for the first frame, and where the images do not show it
  std::vector<LandmarkId>
      landmarks;  ///< one per feature; not valid where it shows none, or none is known yet
};

/// The last frames, by their numbers.
class FrameBuffer {
 public:
  /// Its number follows the last one's.
  void push_back(SurveyFrame&& frame);
  void pop_front() { frames_.pop_front(); }

  [[nodiscard]] const std::deque<SurveyFrame>& all() const { return frames_; }
  [[nodiscard]] bool empty() const { return frames_.empty(); }
  [[nodiscard]] std::size_t size() const { return frames_.size(); }
  [[nodiscard]] const SurveyFrame& front() const { return frames_.front(); }
  [[nodiscard]] const SurveyFrame& back() const { return frames_.back(); }
  /// The frame is in the buffer.
  [[nodiscard]] const SurveyFrame& operator[](KeyframeId id) const { return frames_[position(id)]; }
  [[nodiscard]] SurveyFrame& operator[](KeyframeId id) { return frames_[position(id)]; }
  /// Of a frame in camera_poses().
  [[nodiscard]] std::size_t position(KeyframeId id) const;
  [[nodiscard]] std::vector<CameraFromWorld> camera_poses() const;

 private:
  std::deque<SurveyFrame> frames_;
};

/// Of a frame in the buffer.
[[nodiscard]] const Observation& observation_of(const FrameBuffer& frames, const ObservationRef& observation);

[[nodiscard]] const Keypoint& keypoint_of(const FrameBuffer& frames, const ObservationRef& observation);
[[nodiscard]] Appearance appearance_of(const FrameBuffer& frames, const ObservationRef& observation);

/// The frame with these of its features, in this order.
[[nodiscard]] ObservedFrame select(const ObservedFrame& observed, std::span<const std::uint32_t> features);

/// Multiplies the sigmas of u and v.
void scale_sigmas(double factor, ObservedFrame& observed);

}  // namespace cairn
