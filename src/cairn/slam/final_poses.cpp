// SPDX-License-Identifier: Apache-2.0
#include "cairn/slam/final_poses.h"

#include "cairn/geometry/camera_pose.h"

namespace cairn {

void FrameMemory::remember(std::size_t index, const ObservedFrame& observed, const FramePose& tracked) {
  Remembered remembered{index, {}};
  for (std::size_t i = 0; i < tracked.landmarks.size(); ++i) {
    if (!tracked.landmarks[i].valid()) continue;
    const Observation& seen = observed.observations[i];
    remembered.seen.push_back({tracked.landmarks[i], static_cast<float>(seen.u), static_cast<float>(seen.v),
                               static_cast<float>(seen.d), static_cast<float>(seen.sigma_px),
                               static_cast<float>(seen.sigma_d_px)});
  }
  remembered.seen.shrink_to_fit();
  frames_.push_back(std::move(remembered));
}

void FrameMemory::correct_disparities(const Rig& rig, const DisparityField& field, double min_sigmas) {
  for (Remembered& frame : frames_) {
    for (RememberedObservation& seen : frame.seen) {
      Observation observation = seen.observation();
      correct_disparity(rig, field, min_sigmas, observation);  // NaN stays
      seen.d = static_cast<float>(observation.d);
    }
  }
}

void FrameMemory::weigh_disparities(const Rig& rig, const DisparityNoise& noise) {
  for (Remembered& frame : frames_) {
    for (RememberedObservation& seen : frame.seen)
      if (seen.d == seen.d) seen.sigma_d_px = static_cast<float>(noise.at(rig, static_cast<double>(seen.d)));
  }
}

void FrameMemory::refine_one(const Map& map, const SlamOptions& options, const Remembered& remembered,
                             TrackingResult& track) {
  std::vector<Eigen::Vector3d> points;
  std::vector<Observation> observations;
  for (const RememberedObservation& seen : remembered.seen) {
    if (map[seen.landmark].erased()) continue;
    points.push_back(map[seen.landmark].point_in_world);
    observations.push_back(seen.observation());
  }
  const Rigid3 world_from_reference = map.world_from_camera(*track.reference);
  const Rigid3 start = (world_from_reference * track.reference_from_frame).inverse();
  const PoseEstimate pose = estimate_pose(map.rig(), {points, observations}, CameraFromWorld(start),
                                          {.selection = PoseSelection::inliers_from_all});
  const auto inliers = static_cast<int>(pose.inliers.size());
  if (!pose.found() || inliers < options.min_inliers || 2 * pose.inliers.size() < points.size()) return;
  track.reference_from_frame = world_from_reference.inverse() * pose.camera_from_world.inverse();
}

void FrameMemory::refine(const Map& map, const SlamOptions& options, const Executor& executor,
                         std::vector<TrackingResult>& frames) const {
  executor.for_each(frames_.size(), [&](std::size_t i) {
    TrackingResult& track = frames[frames_[i].index];
    const Keyframe& reference = map[*track.reference];
    const bool is_keyframe = !reference.erased && reference.observed.frame == track.frame;
    if (!is_keyframe) refine_one(map, options, frames_[i], track);
  });
}

}  // namespace cairn
