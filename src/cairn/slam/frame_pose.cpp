// SPDX-License-Identifier: Apache-2.0
#include "cairn/slam/frame_pose.h"

#include <algorithm>

#include "cairn/geometry/camera_pose.h"
#include "cairn/slam/local_map.h"

namespace cairn {
namespace {

/// Returns the correspondences of the landmarks that a frame shows already.
std::vector<Correspondence> points_seen(const Map& map, const FramePose& tracked) {
  std::vector<Correspondence> seen;
  for (std::size_t i = 0; i < tracked.landmarks.size(); ++i) {
    const LandmarkId id = tracked.landmarks[i];
    if (id.valid() && !map[id].erased())
      seen.push_back({static_cast<std::int32_t>(i), id, map[id].point_in_world});
  }
  return seen;
}

std::vector<LandmarkId> landmarks_around(const Map& map, const FramePose& tracked,
                                         const SlamOptions& options) {
  const auto keyframes =
      local_keyframes(map, tracked.landmarks, static_cast<std::size_t>(options.tracking.local_keyframes),
                      static_cast<std::size_t>(options.tracking.local_neighbours));
  std::vector<LandmarkId> seen = tracked.landmarks;
  std::sort(seen.begin(), seen.end());
  std::vector<LandmarkId> around = landmarks_of(map, keyframes, options.mapping.trial_keyframes);
  std::erase_if(around, [&](LandmarkId id) { return std::binary_search(seen.begin(), seen.end(), id); });
  return around;
}

}  // namespace

bool solve_pose(const PosedFrame& view, std::span<const Correspondence> found, int min_inliers,
                FramePose& tracked) {
  std::vector<Eigen::Vector3d> points;
  std::vector<Observation> seen;
  for (const Correspondence& one : found) {
    points.push_back(one.point_in_world);
    seen.push_back(view.observed.observations[static_cast<std::size_t>(one.feature)]);
  }
  const PoseEstimate pose = estimate_pose(view.rig, {points, seen}, CameraFromWorld(view.camera_from_world),
                                          {.selection = PoseSelection::inliers_from_all});
  const int inliers = static_cast<int>(pose.inliers.size());
  if (!pose.found() || inliers < min_inliers) return false;
  tracked.world_from_camera = pose.camera_from_world.inverse();
  tracked.landmarks.assign(view.observed.observations.size(), LandmarkId{});
  for (const std::int32_t i : pose.inliers) {
    const Correspondence& one = found[static_cast<std::size_t>(i)];
    tracked.landmarks[static_cast<std::size_t>(one.feature)] = one.landmark;
  }
  tracked.matches = static_cast<int>(found.size());
  tracked.inliers = inliers;
  tracked.is_determined = is_determined(pose.covariance, median_depth(view.observed));
  return true;
}

bool refine_in_map(const Map& map, const ObservedFrame& observed, const SlamOptions& options,
                   FramePose& tracked) {
  const PosedFrame view{map.rig(), observed, tracked.world_from_camera.inverse()};
  const auto around = landmarks_around(map, tracked, options);
  auto found = points_seen(map, tracked);
  const auto more = find_landmarks(map, around, view, options.tracking.map_radius_px, tracked.landmarks);
  found.insert(found.end(), more.begin(), more.end());
  return solve_pose(view, found, std::max(options.min_inliers, tracked.inliers / 2), tracked);
}

}  // namespace cairn
