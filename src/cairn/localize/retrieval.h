// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cairn/map_files/stored_map.h"
#include "cairn/places/place_index.h"

namespace cairn {

/// Finds the keyframes of the main component that look most like an image, best first, at most `most`. Each
/// descriptor votes for the keyframes that show a landmark which looks like it; its weight falls with their
/// number, as in PlaceIndex. A keyframe that shows n landmarks gets votes by chance in proportion to n, so
/// its sum is divided by the root of n, the length of its vector of words (Sivic and Zisserman 2003). Scores
/// of one query can be compared.
[[nodiscard]] std::vector<PlaceCandidate> find_places(const StoredMap& map, const Descriptors& descriptors,
                                                      std::size_t most);

/// Returns the keyframes of the main component that are nearest to a pose and look within 60 degrees of its
/// direction, nearest first, at most `most`. Distances are divided by the cosine between the optical axes.
[[nodiscard]] std::vector<KeyframeId> keyframes_near(const StoredMap& map,
                                                     const WorldFromCamera& world_from_camera,
                                                     std::size_t most);

}  // namespace cairn
