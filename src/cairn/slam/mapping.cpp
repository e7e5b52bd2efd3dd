// SPDX-License-Identifier: Apache-2.0
#include "cairn/slam/mapping.h"

#include <algorithm>

#include "cairn/slam/local_map.h"

namespace cairn {
namespace {

/// Makes one landmark of two: the one with more observations stays; if equal, the older.
void merge_two(Map& map, LandmarkId a, LandmarkId b) {
  const std::size_t in_a = map[a].observations.size(), in_b = map[b].observations.size();
  const bool keep_a = in_a != in_b ? in_a > in_b : a < b;
  keep_a ? map.merge(b, a) : map.merge(a, b);
}

bool shows(const Landmark& landmark, KeyframeId keyframe) {
  return std::any_of(landmark.observations.begin(), landmark.observations.end(),
                     [&](const ObservationRef& s) { return s.keyframe == keyframe; });
}

/// Searches a keyframe for those of `landmarks` that it does not show, and fuses what is found. Returns how
/// many.
int join_into(Map& map, std::span<const LandmarkId> landmarks, KeyframeId keyframe,
              const SlamOptions& options) {
  std::vector<LandmarkId> wanted;
  for (const LandmarkId id : landmarks)
    if (id.valid() && !map[id].erased() && !shows(map[id], keyframe)) wanted.push_back(id);
  const PosedFrame view{map.rig(), map[keyframe].observed, map[keyframe].world_from_camera.inverse()};
  int joined = 0;
  for (const Correspondence& found : find_landmarks(map, wanted, view, options.tracking.map_radius_px)) {
    const auto feature = static_cast<std::size_t>(found.feature);
    const Eigen::Vector3d point = view.camera_from_world * found.point_in_world;
    const Observation& seen = view.observed.observations[feature];
    if (map[found.landmark].erased() || squared_error(view.rig, point, seen) > squared_error_limit(seen))
      continue;
    const LandmarkId other = map[keyframe].landmarks[feature];
    if (other == found.landmark) continue;
    other.valid() ? merge_two(map, found.landmark, other)
                  : map.add_observation(found.landmark, {keyframe, found.feature});
    ++joined;
  }
  return joined;
}

/// Returns whether three other keyframes show the landmark at the same or a finer scale.
bool is_seen_as_well(const Map& map, const Landmark& landmark, KeyframeId keyframe, float sigma_px) {
  constexpr float kNextLevel = 1.25F;
  constexpr int kOthers = 3;
  int others = 0;
  for (const ObservationRef& observation : landmark.observations) {
    if (observation.keyframe == keyframe) continue;
    const auto& keypoints = map[observation.keyframe].observed.features.keypoints;
    others +=
        keypoints[static_cast<std::size_t>(observation.feature)].sigma_px <= kNextLevel * sigma_px ? 1 : 0;
  }
  return others >= kOthers;
}

bool is_redundant(const Map& map, KeyframeId id, double share) {
  const Keyframe& keyframe = map[id];
  int shown = 0, seen_as_well = 0;
  for (std::size_t i = 0; i < keyframe.landmarks.size(); ++i) {
    if (!keyframe.landmarks[i].valid() || map[keyframe.landmarks[i]].observations.size() < 2) continue;
    ++shown;
    const float sigma = keyframe.observed.features.keypoints[i].sigma_px;
    seen_as_well += is_seen_as_well(map, map[keyframe.landmarks[i]], id, sigma) ? 1 : 0;
  }
  return seen_as_well > share * shown;
}

}  // namespace

KeyframeId add_keyframe(IndexedMap& indexed, const ObservedFrame& observed, const FramePose& tracked,
                        KeyframeId parent, std::int32_t component) {
  const KeyframeId id =
      indexed.add_keyframe(ObservedFrame(observed), tracked.world_from_camera, parent, component);
  Map& map = indexed.edit();
  for (std::size_t i = 0; i < tracked.landmarks.size(); ++i) {
    const LandmarkId landmark = tracked.landmarks[i];
    if (!landmark.valid() || map[landmark].erased() || shows(map[landmark], id)) continue;
    map.add_observation(landmark, {id, static_cast<std::int32_t>(i)});
  }
  return id;
}

int add_landmarks_by_depth(Map& map, KeyframeId id) {
  int added = 0;
  for (std::size_t i = 0; i < map[id].landmarks.size(); ++i) {
    const Eigen::Vector3d& point = map[id].observed.points_in_camera[i];
    if (map[id].landmarks[i].valid() || !point.allFinite()) continue;
    map.add_landmark(map[id].world_from_camera * point, {id, static_cast<std::int32_t>(i)});
    ++added;
  }
  return added;
}

int fuse_with_neighbours(Map& map, KeyframeId id, const SlamOptions& options) {
  const auto neighbours = neighbours_of(map, id, static_cast<std::size_t>(options.tracking.local_keyframes));
  int joined = 0;
  for (const KeyframeId neighbour : neighbours)
    joined += join_into(map, std::vector<LandmarkId>(map[id].landmarks), neighbour, options);
  return joined + join_into(map, landmarks_of(map, neighbours, options.mapping.trial_keyframes), id, options);
}

int fuse_neighbourhoods(Map& map, KeyframeId a, KeyframeId b, const SlamOptions& options) {
  const auto count = static_cast<std::size_t>(options.tracking.local_keyframes);
  std::vector<KeyframeId> around_a = neighbours_of(map, a, count), around_b = neighbours_of(map, b, count);
  around_a.push_back(a);
  around_b.push_back(b);
  int joined = 0;
  for (const KeyframeId keyframe : around_b)
    joined += join_into(map, landmarks_of(map, around_a, options.mapping.trial_keyframes), keyframe, options);
  for (const KeyframeId keyframe : around_a)
    joined += join_into(map, landmarks_of(map, around_b, options.mapping.trial_keyframes), keyframe, options);
  return joined;
}

int cull_landmarks(Map& map) {
  int erased = 0;
  for (const LandmarkId id : map.landmark_ids()) {
    if (map[id].observations.size() > 1) continue;
    map.erase(id);
    ++erased;
  }
  return erased;
}

std::vector<KeyframeId> cull_keyframes(IndexedMap& indexed, KeyframeId keyframe,
                                       const MappingOptions& options) {
  const Map& map = indexed.map();
  std::vector<KeyframeId> erased;
  for (const KeyframeId id : neighbours_of(map, keyframe)) {
    const bool is_first = !map[id].parent.valid();
    if (is_first || !is_redundant(map, id, options.redundant_share)) continue;
    indexed.erase(id);
    erased.push_back(id);
  }
  return erased;
}

}  // namespace cairn
