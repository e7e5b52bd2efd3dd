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

/// Holds the motion of the camera since the frame before, as measured in the images.
struct VisualMotion {
  Rigid3 previous_from_this;
  double rotation_variance = 0;     ///< per axis, radians squared
  double translation_variance = 0;  ///< per axis, square metres
};

/// Holds a landmark as it is without what one frame shows of it.
struct HeldOutLandmark {
  std::int32_t feature = -1;  ///< of the frame that is held out
  Eigen::Vector3d point_in_world = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< square metres
};

/// Holds a frame with its pose, for as long as tracks need it.
struct SurveyFrame {
  KeyframeId id;
  ObservedFrame observed;           ///< useful features only, see drop_unused_features
  std::vector<std::uint32_t> kept;  ///< positions of these features among all of the image
  GivenPose given;
  WorldFromCamera world_from_camera;  ///< the given pose, or the smoothed one (smoothed_pose)
  CameraFromWorld camera_from_world;  ///< inverse of world_from_camera
  /// world_from_camera in the world of the tracks: the motion from the frame before, if measured, else that
  /// of the given poses. It drifts, but within a window it fits the images better than the given poses do.
  WorldFromCamera odometry;
  std::optional<VisualMotion> motion;  ///< nullopt for the first frame, and if the images do not show it
  /// One per feature; not valid if it shows no landmark, or none is known yet.
  std::vector<LandmarkId> landmarks;
  std::vector<HeldOutLandmark> held_out;  ///< of landmarks that are written, if is_held_out(id)
};

/// Makes a frame with the given pose, and with standard deviations scaled by `sigma_px`.
[[nodiscard]] SurveyFrame make_frame(KeyframeId id, ObservedFrame observed, const GivenPose& given,
                                     double sigma_px);

/// Returns the covariance that a given pose states, of left_perturbation(camera_from_world as given, as it
/// is): rotation (radians), then centre (metres), in the camera's axes. Zero for what it does not state.
[[nodiscard]] Matrix6d stated_covariance(const GivenPose& given);

/// Returns the variances of a pose that count as none, in the order of stated_covariance: 1e-6 radians, 1e-5
/// metres.
[[nodiscard]] Vector6d least_variances();

/// Holds the last frames, which have successive numbers.
class FrameBuffer {
 public:
  /// Appends a frame. Throws PreconditionError unless its number follows that of the last one.
  void push_back(SurveyFrame&& frame);
  void pop_front() { frames_.pop_front(); }

  [[nodiscard]] const std::deque<SurveyFrame>& all() const { return frames_; }
  [[nodiscard]] bool empty() const { return frames_.empty(); }
  [[nodiscard]] std::size_t size() const { return frames_.size(); }
  [[nodiscard]] const SurveyFrame& front() const { return frames_.front(); }
  [[nodiscard]] const SurveyFrame& back() const { return frames_.back(); }
  /// Returns the frame with number `id`. Throws PreconditionError if it is not in the buffer.
  [[nodiscard]] const SurveyFrame& operator[](KeyframeId id) const { return frames_[position(id)]; }
  [[nodiscard]] SurveyFrame& operator[](KeyframeId id) { return frames_[position(id)]; }
  /// Returns the position of a frame in all() and camera_poses(). Throws PreconditionError if it is not in
  /// the buffer.
  [[nodiscard]] std::size_t position(KeyframeId id) const;
  /// Returns camera_from_world of each frame, in order.
  [[nodiscard]] std::vector<CameraFromWorld> camera_poses() const;

 private:
  std::deque<SurveyFrame> frames_;
};

/// Returns the observation that `observation` refers to, of a frame in the buffer.
[[nodiscard]] const Observation& observation_of(const FrameBuffer& frames, const ObservationRef& observation);

/// Returns the keypoint that `observation` refers to, of a frame in the buffer.
[[nodiscard]] const Keypoint& keypoint_of(const FrameBuffer& frames, const ObservationRef& observation);
/// Returns the appearance of the feature that `observation` refers to, seen from the frame's odometry pose.
/// It refers to descriptors in the buffer.
[[nodiscard]] Appearance appearance_of(const FrameBuffer& frames, const ObservationRef& observation);

/// Returns the frame with only the given features, in the given order.
[[nodiscard]] ObservedFrame select(const ObservedFrame& observed, std::span<const std::uint32_t> features);

/// Multiplies the standard deviations of u and v by `factor`.
void scale_sigmas(double factor, ObservedFrame& observed);

}  // namespace cairn
