// SPDX-License-Identifier: Apache-2.0
#include "cairn/slam/indexed_map.h"

#include <utility>

namespace cairn {

IndexedMap::IndexedMap(Map map) : map_(std::move(map)) {
  for (const KeyframeId id : map_.keyframe_ids())
    places_.add(id.value, map_[id].observed.features.descriptors);
}

KeyframeId IndexedMap::add_keyframe(ObservedFrame&& observed, const Rigid3& world_from_camera,
                                    KeyframeId parent, std::int32_t component) {
  const KeyframeId id = map_.add_keyframe(std::move(observed), world_from_camera, parent, component);
  places_.add(id.value, map_[id].observed.features.descriptors);
  return id;
}

void IndexedMap::erase(KeyframeId keyframe) {
  map_.erase(keyframe);
  places_.remove(keyframe.value);
}

Map IndexedMap::release() {
  places_ = PlaceIndex();
  return std::exchange(map_, Map());
}

}  // namespace cairn
