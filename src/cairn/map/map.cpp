// SPDX-License-Identifier: Apache-2.0
#include "cairn/map/map.h"

#include <algorithm>

#include "cairn/core/error.h"

namespace cairn {
namespace {

std::vector<Sighting>::const_iterator find_sighting(const Landmark& landmark, KeyframeId keyframe) {
  const auto place = std::lower_bound(landmark.sightings.begin(), landmark.sightings.end(), keyframe,
                                      [](const Sighting& s, KeyframeId id) { return s.keyframe < id; });
  return place != landmark.sightings.end() && place->keyframe == keyframe ? place : landmark.sightings.end();
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

std::int32_t Map::part_of(KeyframeId id) const {
  while ((*this)[id].erased) id = (*this)[id].anchor;
  return (*this)[id].part;
}

KeyframeId Map::add_keyframe(ObservedFrame&& observed, const Rigid3& world_from_camera, KeyframeId parent,
                             std::int32_t part) {
  const KeyframeId id{static_cast<std::int32_t>(keyframes_.size())};
  require(parent < id, "a keyframe's parent is earlier");
  Keyframe keyframe;
  keyframe.id = id;
  keyframe.landmarks.resize(observed.observations.size());
  keyframe.observed = std::move(observed);
  keyframe.world_from_camera = world_from_camera;
  keyframe.parent = parent;
  keyframe.part = part;
  keyframes_.push_back(std::move(keyframe));
  return id;
}

LandmarkId Map::add_landmark(const Eigen::Vector3d& point_in_world, Sighting first) {
  const LandmarkId id{static_cast<std::int32_t>(landmarks_.size())};
  landmarks_.push_back({id, point_in_world, {}});
  add_sighting(id, first);
  return id;
}

void Map::add_sighting(LandmarkId id, Sighting sighting) {
  LandmarkId& shown = keyframe(sighting.keyframe).landmarks.at(static_cast<std::size_t>(sighting.feature));
  require(!shown.valid(), "a feature shows one landmark");
  Landmark& seen = landmark(id);
  require(find_sighting(seen, sighting.keyframe) == seen.sightings.end(), "a keyframe shows a landmark once");
  shown = id;
  seen.sightings.insert(std::upper_bound(seen.sightings.begin(), seen.sightings.end(), sighting), sighting);
}

void Map::remove_sighting(LandmarkId id, KeyframeId from) {
  Landmark& seen = landmark(id);
  const auto place = find_sighting(seen, from);
  if (place == seen.sightings.end()) return;
  keyframe(from).landmarks[static_cast<std::size_t>(place->feature)] = {};
  seen.sightings.erase(place);
}

void Map::merge(LandmarkId gone, LandmarkId kept) {
  require(gone != kept, "two landmarks to merge");
  const std::vector<Sighting> sightings = (*this)[gone].sightings;
  erase(gone);
  for (const Sighting& sighting : sightings) {
    if (find_sighting((*this)[kept], sighting.keyframe) == (*this)[kept].sightings.end())
      add_sighting(kept, sighting);
  }
}

void Map::erase(LandmarkId id) {
  for (const Sighting& sighting : landmark(id).sightings)
    keyframe(sighting.keyframe).landmarks[static_cast<std::size_t>(sighting.feature)] = {};
  landmark(id).sightings.clear();
}

void Map::erase(KeyframeId id) {
  Keyframe& gone = keyframe(id);
  require(!gone.erased, "a keyframe is erased once");
  require(gone.parent.valid(), "the first keyframe of a part stays");
  gone.anchor = gone.parent;
  while ((*this)[gone.anchor].erased) gone.anchor = (*this)[gone.anchor].anchor;
  gone.anchor_from_camera = (*this)[gone.anchor].world_from_camera.inverse() * gone.world_from_camera;
  for (const LandmarkId shown : std::vector<LandmarkId>(gone.landmarks))
    if (shown.valid()) remove_sighting(shown, id);
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

void Map::set_part(KeyframeId id, std::int32_t part) {
  keyframe(id).part = part;
}

void Map::end_recording() {
  for (Keyframe& keyframe : keyframes_) keyframe.observed.frame = {};
}

}  // namespace cairn
