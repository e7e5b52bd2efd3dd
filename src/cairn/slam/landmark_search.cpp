// SPDX-License-Identifier: Apache-2.0
#include "cairn/slam/landmark_search.h"

#include <algorithm>

namespace cairn {
Appearance nearest_appearance(const Map& map, const Landmark& landmark,
                              const Eigen::Vector3d& centre_in_world) {
  const auto distance = [&](const ObservationRef& observation) {
    return (map[observation.keyframe].world_from_camera.translation - centre_in_world).squaredNorm();
  };
  const auto nearest = std::min_element(
      landmark.observations.begin(), landmark.observations.end(),
      [&](const ObservationRef& a, const ObservationRef& b) { return distance(a) < distance(b); });
  const Keyframe& keyframe = map[nearest->keyframe];
  const auto row = static_cast<std::size_t>(nearest->feature);
  const Features& features = keyframe.observed.features;
  return {&features.descriptors, row, features.keypoints[row], keyframe.world_from_camera.translation};
}

std::vector<Correspondence> find_landmarks(const Map& map, std::span<const LandmarkId> landmarks,
                                           const PosedFrame& frame, double radius_px,
                                           std::span<const LandmarkId> occupied) {
  GuidedSearch search(frame, radius_px);
  const Eigen::Vector3d centre = frame.camera_from_world.inverse().translation;
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    const Landmark& landmark = map[landmarks[i]];
    search.add(i, landmark.point_in_world, nearest_appearance(map, landmark, centre));
  }
  std::vector<Correspondence> found;
  for (const GuidedMatch& match : search.match()) {
    if (!occupied.empty() && occupied[static_cast<std::size_t>(match.feature)].valid()) continue;
    const LandmarkId id = landmarks[match.point];
    found.push_back({match.feature, id, map[id].point_in_world});
  }
  return found;
}

}  // namespace cairn
