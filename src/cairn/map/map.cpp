// SPDX-License-Identifier: Apache-2.0
#include "cairn/map/map.h"

#include <algorithm>

#include "cairn/core/error.h"

namespace cairn {
namespace {

std::vector<ObservationRef>::const_iterator find_observation(const Landmark& landmark, KeyframeId keyframe) {
  const auto place = std::lower_bound(landmark.observations.begin(), landmark.observations.end(), keyframe,
                                      [](const ObservationRef& s, KeyframeId id) { return s.keyframe < id; });
  return place != landmark.observations.end() && place->keyframe == keyframe ? place
                                                                             : landmark.observations.end();
}

}  // namespace

std::vector<KeyframeId> Map::keyframe_ids() const {
  std::vector<KeyframeId> ids;
  for (const Keyframe& keyframe : keyframes_)
    if (!keyframe.erased) ids.push_back(keyframe.id);
  return ids;
}

std::vector<LandmarkId> Map::landmark_ids() const {
  std::vector<LandmarkId> ids;
  for (const Landmark& landmark : landmarks_)
    if (!landmark.erased()) ids.push_back(landmark.id);
  return ids;
}

Rigid3 Map::world_from_camera(KeyframeId id) const {
  Rigid3 ancestor_from_camera;
  while ((*this)[id].erased) {
    ancestor_from_camera = (*this)[id].anchor_from_camera * ancestor_from_camera;
    id = (*this)[id].anchor;
  }
  return (*this)[id].world_from_camera * ancestor_from_camera;
}

std::int32_t Map::component_of(KeyframeId id) const {
  while ((*this)[id].erased) id = (*this)[id].anchor;
  return (*this)[id].component;
}

KeyframeId Map::add_keyframe(ObservedFrame&& observed, const Rigid3& world_from_camera, KeyframeId parent,
                             std::int32_t component) {
  const KeyframeId id{static_cast<std::int32_t>(keyframes_.size())};
  require(parent < id, "a keyframe's parent is earlier");
  Keyframe keyframe;
  keyframe.id = id;
  keyframe.landmarks.resize(observed.observations.size());
  keyframe.observed = std::move(observed);
  keyframe.world_from_camera = world_from_camera;
  keyframe.parent = parent;
  keyframe.component = component;
  keyframes_.push_back(std::move(keyframe));
  return id;
}

LandmarkId Map::add_landmark(const Eigen::Vector3d& point_in_world, ObservationRef first) {
  const LandmarkId id{static_cast<std::int32_t>(landmarks_.size())};
  landmarks_.push_back({id, point_in_world, {}});
  add_observation(id, first);
  return id;
}

void Map::add_observation(LandmarkId id, ObservationRef observation) {
  LandmarkId& shown =
      keyframe(observation.keyframe).landmarks.at(static_cast<std::size_t>(observation.feature));
  require(!shown.valid(), "a feature shows one landmark");
  Landmark& seen = landmark(id);
  require(find_observation(seen, observation.keyframe) == seen.observations.end(),
          "a keyframe shows a landmark once");
  shown = id;
  seen.observations.insert(std::upper_bound(seen.observations.begin(), seen.observations.end(), observation),
                           observation);
}

void Map::remove_observation(LandmarkId id, KeyframeId from) {
  Landmark& seen = landmark(id);
  const auto place = find_observation(seen, from);
  if (place == seen.observations.end()) return;
  keyframe(from).landmarks[static_cast<std::size_t>(place->feature)] = {};
  seen.observations.erase(place);
}

void Map::remove_disparity(LandmarkId id, KeyframeId shown_by) {
  const Landmark& seen = landmark(id);
  const auto place = find_observation(seen, shown_by);
  if (place == seen.observations.end()) return;
  const bool has_other =
      std::any_of(seen.observations.begin(), seen.observations.end(), [&](const ObservationRef& other) {
        const auto& observations = keyframe(other.keyframe).observed.observations;
        return other.keyframe != shown_by &&
               observations[static_cast<std::size_t>(other.feature)].has_disparity();
      });
  if (!has_other) return remove_observation(id, shown_by);
  ObservedFrame& frame = keyframe(shown_by).observed;
  const auto feature = static_cast<std::size_t>(place->feature);
  frame.observations[feature] = without_disparity(frame.observations[feature]);
  frame.points_in_camera[feature] = point_in_camera(rig(), frame.observations[feature]);
}

void Map::merge(LandmarkId gone, LandmarkId kept) {
  require(gone != kept, "two landmarks to merge");
  const std::vector<ObservationRef> observations = (*this)[gone].observations;
  erase(gone);
  for (const ObservationRef& observation : observations) {
    if (find_observation((*this)[kept], observation.keyframe) == (*this)[kept].observations.end())
      add_observation(kept, observation);
  }
}

void Map::erase(LandmarkId id) {
  for (const ObservationRef& observation : landmark(id).observations)
    keyframe(observation.keyframe).landmarks[static_cast<std::size_t>(observation.feature)] = {};
  landmark(id).observations.clear();
}

void Map::erase(KeyframeId id) {
  Keyframe& gone = keyframe(id);
  require(!gone.erased, "a keyframe is erased once");
  require(gone.parent.valid(), "the first keyframe of a part stays");
  gone.anchor = gone.parent;
  while ((*this)[gone.anchor].erased) gone.anchor = (*this)[gone.anchor].anchor;
  gone.anchor_from_camera = (*this)[gone.anchor].world_from_camera.inverse() * gone.world_from_camera;
  for (const LandmarkId shown : std::vector<LandmarkId>(gone.landmarks))
    if (shown.valid()) remove_observation(shown, id);
  gone.landmarks.clear();
  gone.observed = {gone.observed.frame, gone.observed.stamp_ns, {}, {}, {}};
  gone.erased = true;
}

void Map::move(KeyframeId id, const Rigid3& world_from_camera) {
  keyframe(id).world_from_camera = world_from_camera;
}

void Map::move(LandmarkId id, const Eigen::Vector3d& point_in_world) {
  landmark(id).point_in_world = point_in_world;
}

void Map::set_component(KeyframeId id, std::int32_t component) {
  keyframe(id).component = component;
}

void Map::correct_disparities(const DisparityField& field, double min_sigmas) {
  for (Keyframe& keyframe : keyframes_)
    cairn::correct_disparities(rig(), field, min_sigmas, keyframe.observed);
  for (Landmark& landmark : landmarks_) {
    if (landmark.erased() || landmark.observations.size() != 1) continue;
    const auto [id, feature] = landmark.observations.front();
    const Eigen::Vector3d& point = keyframe(id).observed.points_in_camera[static_cast<std::size_t>(feature)];
    if (point.allFinite()) landmark.point_in_world = keyframe(id).world_from_camera * point;
  }
  if (!header_.right_correction) header_.right_correction.emplace();
  header_.right_correction->disparity += field;
}

void Map::weigh_disparities(const DisparityNoise& noise) {
  for (Keyframe& keyframe : keyframes_) cairn::weigh_disparities(rig(), noise, keyframe.observed);
  header_.depth_noise = noise;
}

void Map::end_recording() {
  for (Keyframe& keyframe : keyframes_) keyframe.observed.frame = {};
}

}  // namespace cairn
