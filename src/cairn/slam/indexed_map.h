// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "cairn/map/map.h"
#include "cairn/places/place_index.h"

namespace cairn {

/// Holds a map together with the index of what its keyframes look like, and keeps the two in step: the index
/// has exactly the keyframes that are not erased.
class IndexedMap {
 public:
  IndexedMap() = default;
  /// Indexes the keyframes of `map`. Throws PreconditionError if their descriptors are of different kinds.
  explicit IndexedMap(Map map);

  [[nodiscard]] const Map& map() const { return map_; }
  [[nodiscard]] const PlaceIndex& places() const { return places_; }
  /// Gives access to poses, landmarks and components; keyframes are added and erased by this class alone.
  [[nodiscard]] Map& edit() { return map_; }

  /// Adds a keyframe to the map (Map::add_keyframe) and to the index.
  KeyframeId add_keyframe(ObservedFrame&& observed, const Rigid3& world_from_camera, KeyframeId parent,
                          std::int32_t component);
  /// Erases a keyframe that is not erased from the map (Map::erase) and from the index.
  void erase(KeyframeId keyframe);

  /// Moves the map out; this object is empty afterwards.
  [[nodiscard]] Map release();

 private:
  Map map_;
  PlaceIndex places_;
};

}  // namespace cairn
