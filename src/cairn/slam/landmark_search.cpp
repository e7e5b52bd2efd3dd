// SPDX-License-Identifier: Apache-2.0
#include "cairn/slam/landmark_search.h"

#include <algorithm>

namespace cairn {
Appearance nearest_appearance(const Map& map, const Landmark& landmark,
                              const Eigen::Vector3d& centre_in_world) {
  const auto distance = [&](const Sighting& sighting) {
    return (map[sighting.keyframe].world_from_camera.translation - centre_in_world).squaredNorm();
  };
  const auto nearest =
      std::min_element(landmark.sightings.begin(), landmark.sightings.end(),
                       [&](const Sighting& a, const Sighting& b) { return distance(a) < distance(b); });
  const Keyframe& keyframe = map[nearest->keyframe];
  const auto row = static_cast<std::size_t>(nearest->feature);
  const Features& features = keyframe.observed.features;
  return {&features.descriptors, row, features.keypoints[row], keyframe.world_from_camera.translation};
}

SearchTargets landmark_targets(const Map& map, std::span<const LandmarkId> landmarks, const FrameView& view,
                               double radius_px) {
  SearchTargets targets;
  const Eigen::Vector3d centre = view.camera_from_world.inverse().translation;
  for (const LandmarkId id : landmarks) {
    const Landmark& landmark = map[id];
    const Appearance appearance = nearest_appearance(map, landmark, centre);
    const auto place = predict_place(view, landmark.point_in_world, appearance, radius_px);
    if (!place) continue;
    targets.points_in_world.push_back(landmark.point_in_world);
    targets.landmarks.push_back(id);
    targets.places.push_back(*place);
    targets.appearances.push_back(appearance);
  }
  return targets;
}

std::vector<FoundPoint> find_targets(const SearchTargets& targets, const FrameView& view,
                                     std::span<const LandmarkId> occupied, const MatchOptions& options) {
  std::vector<FoundPoint> found;
  if (targets.size() == 0) return found;
  const auto matches =
      match_predicted(targets.places, gather(targets.appearances), view.observed.features, options);
  for (const Match& match : matches) {
    const auto target = static_cast<std::size_t>(match.query),
               feature = static_cast<std::size_t>(match.train);
    if (!occupied.empty() && occupied[feature].valid()) continue;
    found.push_back({match.train, targets.landmarks[target], targets.points_in_world[target]});
  }
  return found;
}

}  // namespace cairn
