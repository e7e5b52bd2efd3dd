// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "cairn/slam/indexed_map.h"
#include "cairn/testing/map/point_world.h"

namespace cairn::testkit {

/// Makes a map as odometry does: each keyframe is placed after the one before, and landmarks where the first
/// keyframe that shows them says. A point that `memory` keyframes in a row have not shown becomes another
/// landmark when it is seen again.
struct MapMaker {
  explicit MapMaker(PointWorld seen_world, int keyframes_remembered = std::numeric_limits<int>::max());

  MapMaker(const MapMaker& other);
  MapMaker& operator=(const MapMaker&) = delete;
  ~MapMaker() = default;

  /// Adds a keyframe that is at `truth`, and in the map at `placed`.
  KeyframeId add(const Rigid3& truth, const Rigid3& placed);
  KeyframeId add(const Rigid3& truth) { return add(truth, truth); }

  struct Known {
    LandmarkId landmark;
    std::int32_t last_seen = 0;
  };
  PointWorld world;
  int memory;
  std::vector<Known> known;
  IndexedMap indexed{Map(kWorldRig, "ORB")};
  Map& map = indexed.edit();
};

}  // namespace cairn::testkit
