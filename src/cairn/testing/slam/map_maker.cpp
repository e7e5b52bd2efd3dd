// SPDX-License-Identifier: Apache-2.0
#include "cairn/testing/slam/map_maker.h"

#include <utility>

namespace cairn::testkit {

MapMaker::MapMaker(PointWorld seen_world, int keyframes_remembered)
    : world(std::move(seen_world)), memory(keyframes_remembered), known(world.points.size()) {}

MapMaker::MapMaker(const MapMaker& other)
    : world(other.world), memory(other.memory), known(other.known), indexed(other.indexed) {}

KeyframeId MapMaker::add(const Rigid3& truth, const Rigid3& placed) {
  const auto next = static_cast<std::int32_t>(map.keyframes().size());
  View view = world.see(truth, next);
  const KeyframeId id = indexed.add_keyframe(std::move(view.observed), placed, {next - 1}, 0);
  for (std::size_t i = 0; i < view.points.size(); ++i) {
    Known& point = known[view.points[i]];
    const ObservationRef observation{id, static_cast<std::int32_t>(i)};
    if (point.landmark.valid() && next - point.last_seen <= memory) {
      map.add_observation(point.landmark, observation);
    } else {
      point.landmark = map.add_landmark(placed * map[id].observed.points_in_camera[i], observation);
    }
    point.last_seen = next;
  }
  return id;
}

}  // namespace cairn::testkit
