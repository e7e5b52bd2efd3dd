// SPDX-License-Identifier: Apache-2.0
#include "cairn/survey/held_out.h"

#include <algorithm>

#include "cairn/geometry/camera_pose.h"

namespace cairn {
namespace {

/// Returns the observations that the fit kept.
std::vector<CameraObservation> kept(std::span<const CameraObservation> observations, const LandmarkFit& fit) {
  std::vector<CameraObservation> result;
  for (std::size_t i = 0; i < observations.size(); ++i)
    if (fit.kept[i] != 0) result.push_back(observations[i]);
  return result;
}

}  // namespace

bool is_held_out(KeyframeId frame) {
  constexpr std::int32_t kEvery = 3, kFirst = 1;
  return frame.value % kEvery == kFirst;
}

HoldOut::HoldOut(const Rig& rig, const SurveyOptions& options, const NoisePrior& prior, FrameBuffer& frames)
    : rig_(rig),
      prior_(prior),
      frames_(frames),
      cameras_(frames.camera_poses()),
      solver_(rig, cameras_, options.fit) {}

void HoldOut::add(const SurveyLandmark& landmark) {
  const std::vector<CameraObservation> all = with_positions(frames_, landmark.observations);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const ObservationRef& observation = landmark.observations[i];
    if (!is_held_out(observation.keyframe)) continue;
    std::vector<CameraObservation> others = all;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    solver_.fit(others, fit_);
    if (fit_.status != LandmarkFitStatus::ok) continue;
    const auto information = information_of(rig_, cameras_, kept(others, fit_), fit_.point_in_world);
    const Eigen::Matrix3d own = prior_.noise.covariance_of(information);
    frames_[observation.keyframe].held_out.push_back({observation.feature, fit_.point_in_world, own});
  }
}

std::optional<HeldOutFrame> locate_held_out(const Rig& rig, const SurveyFrame& frame, double sigma_px) {
  std::vector<Eigen::Vector3d> points;
  std::vector<Observation> seen;
  std::vector<Eigen::Matrix3d> covariances;
  for (const HeldOutLandmark& landmark : frame.held_out) {
    points.push_back(landmark.point_in_world);
    covariances.push_back(landmark.covariance);
    seen.push_back(frame.observed.observations[static_cast<std::size_t>(landmark.feature)]);
    seen.back().sigma_px /= sigma_px;
  }
  if (points.size() < kFewestHeldOutInliers) return std::nullopt;
  const PoseEstimate pose =
      estimate_pose(rig, {points, seen, covariances}, frame.camera_from_world, {.keep_pixels = false});
  if (!pose.found() || pose.inliers.size() < kFewestHeldOutInliers) return std::nullopt;
  HeldOutFrame result;
  result.keyframe = frame.id;
  result.to_map = left_perturbation(pose.camera_from_world, frame.camera_from_world);
  result.to_given = left_perturbation(pose.camera_from_world, frame.given.world_from_camera.inverse());
  result.formal = pose.variance_factor * pose.covariance.diagonal().cwiseMax(0.0);
  result.stated = stated_covariance(frame.given).diagonal().cwiseMax(0.0);
  return result;
}

}  // namespace cairn
