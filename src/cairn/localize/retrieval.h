// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cairn/map_files/stored_map.h"
#include "cairn/places/place_index.h"

namespace cairn {

/// The keyframes of the main component that look most like an image, best first, at most `most`: each
/// descriptor votes for the keyframes that show a landmark which looks like it, and weighs the less the more
/// they are, as in PlaceIndex. A keyframe that shows n landmarks gets votes by chance in proportion to n, so
/// its sum is divided by the root of n, the length of its vector of words (Sivic and Zisserman 2003); scores
/// of one query can be compared.
[[nodiscard]] std::vector<PlaceCandidate> find_places(const StoredMap& map, const Descriptors& descriptors,
                                                      std::size_t most);

/// The keyframes that were nearest to a pose and looked the same way, nearest first, at most `most`.
[[nodiscard]] std::vector<KeyframeId> keyframes_near(const StoredMap& map,
                                                     const WorldFromCamera& world_from_camera,
                                                     std::size_t most);

}  // namespace cairn
