// SPDX-License-Identifier: Apache-2.0
#include "cairn/survey/landmarks.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "cairn/geometry/covariance.h"
#include "cairn/map_files/frame_file.h"
#include "cairn/optimize/landmark_fit.h"

namespace cairn {
namespace {

SurveyLandmark make_landmark(const Rig& rig, const FrameBuffer& frames,
                             std::span<const CameraFromWorld> cameras,
                             std::span<const ObservationRef> observations, const LandmarkFit& fit) {
  SurveyLandmark landmark;
  for (std::size_t i = 0; i < observations.size(); ++i) {
    if (fit.kept[i] != 0) landmark.observations.push_back(observations[i]);
  }
  landmark.point_in_world = fit.point_in_world;
  landmark.cofactor = fit.covariance;
  landmark.squared_error_sum = fit.squared_error_sum;
  landmark.redundancy = fit.redundancy;
  landmark.information =
      information_of(rig, cameras, with_positions(frames, landmark.observations), fit.point_in_world);
  landmark.indicators =
      indicators_of(rig, fit.point_in_world, views_of(frames, cameras, landmark.observations));
  return landmark;
}

/// Computes the covariance of c + w x lever, with the errors (c, w) of a pose.
Eigen::Matrix3d covariance_at(const PoseUncertainty& pose, const Eigen::Vector3d& lever) {
  const Eigen::Matrix3d by_rotation = skew(-lever);
  const Eigen::Matrix3d both = pose.position_rotation * by_rotation.transpose();
  return as_covariance(pose.position + by_rotation * pose.rotation * by_rotation.transpose() + both +
                       both.transpose());
}

Eigen::Matrix3d pose_covariance_of(const FrameBuffer& frames, const SurveyLandmark& landmark) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const ObservationRef& observation : landmark.observations) {
    const GivenPose& given = frames[observation.keyframe].given;
    if (!given.uncertainty) continue;
    const Eigen::Vector3d lever = landmark.point_in_world - given.world_from_camera.translation;
    sum += covariance_at(*given.uncertainty, lever);
  }
  return sum / static_cast<double>(landmark.observations.size());
}

}  // namespace

std::vector<CameraObservation> with_positions(const FrameBuffer& frames,
                                              std::span<const ObservationRef> observations) {
  std::vector<CameraObservation> result;
  for (const ObservationRef& observation : observations)
    result.push_back({static_cast<std::int32_t>(frames.position(observation.keyframe)),
                      observation_of(frames, observation)});
  return result;
}

std::vector<PosedObservation> views_of(const FrameBuffer& frames, std::span<const CameraFromWorld> cameras,
                                       std::span<const ObservationRef> observations) {
  std::vector<PosedObservation> views;
  for (const ObservationRef& observation : observations)
    views.push_back(
        {cameras[frames.position(observation.keyframe)], as_stored(observation_of(frames, observation))});
  return views;
}

std::optional<SurveyLandmark> fit_observations(const Rig& rig, const FrameBuffer& frames,
                                               std::span<const ObservationRef> observations,
                                               const SurveyOptions& options) {
  const auto cameras = frames.camera_poses();
  const LandmarkFit fit = fit_landmark(rig, cameras, with_positions(frames, observations), options.fit);
  if (fit.status != LandmarkFitStatus::ok) return std::nullopt;
  return make_landmark(rig, frames, cameras, observations, fit);
}

AdjustedTracks adjust_tracks(const Rig& rig, const FrameBuffer& frames, std::span<const Track> tracks,
                             const SurveyOptions& options, const Executor& executor) {
  AdjustedTracks adjusted;
  const auto cameras = frames.camera_poses();
  std::vector<std::optional<SurveyLandmark>> fits(tracks.size());
  constexpr std::size_t kGrain = 64;  // tracks of a chunk: about a millisecond
  executor.for_each_chunk(tracks.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    LandmarkSolver solver(rig, cameras, options.fit);
    LandmarkFit fit;
    for (std::size_t i = begin; i < end; ++i) {
      solver.fit(with_positions(frames, tracks[i].observations), fit);
      if (fit.status == LandmarkFitStatus::ok)
        fits[i] = make_landmark(rig, frames, cameras, tracks[i].observations, fit);
    }
  });
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    if (static_cast<int>(tracks[i].observations.size()) < options.fit.min_observations) {
      ++adjusted.too_short;
    } else if (!fits[i]) {
      ++adjusted.inconsistent;
    } else {
      adjusted.dropped_observations +=
          static_cast<std::int64_t>(tracks[i].observations.size() - fits[i]->observations.size());
      adjusted.landmarks.push_back(std::move(*fits[i]));
    }
  }
  return adjusted;
}

void complete_covariance(const FrameBuffer& frames, const NoisePrior& prior, bool pose_errors,
                         SurveyLandmark& landmark) {
  landmark.variance_factor = prior.variance.factor(landmark.squared_error_sum, landmark.redundancy);
  landmark.image_covariance = prior.noise.covariance_of(landmark.information);
  if (pose_errors) landmark.pose_covariance = pose_covariance_of(frames, landmark);
}

}  // namespace cairn
