// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cairn/slam/frame_pose.h"
#include "cairn/slam/indexed_map.h"

namespace cairn {

// The steps by which a keyframe extends the map; all are deterministic.

/// Adds a keyframe with the pose of `tracked`, and observations of the landmarks that it shows. Returns its
/// id.
KeyframeId add_keyframe(IndexedMap& indexed, const ObservedFrame& observed, const FramePose& tracked,
                        KeyframeId parent, std::int32_t component);

/// Makes a landmark of each feature of the keyframe that has a depth and shows no landmark. Returns how many.
int add_landmarks_by_depth(Map& map, KeyframeId keyframe);

/// Searches the neighbours of the keyframe for its landmarks, and the keyframe for theirs. A match becomes an
/// observation or, if the feature shows another landmark, makes one landmark of the two. Returns the number
/// of matches.
int fuse_with_neighbours(Map& map, KeyframeId keyframe, const SlamOptions& options);

/// Fuses the landmarks of two keyframes that show one place: searches `b` and its neighbours for the
/// landmarks of `a` and its neighbours, and the reverse (see fuse_with_neighbours). Returns the number of
/// matches.
int fuse_neighbourhoods(Map& map, KeyframeId a, KeyframeId b, const SlamOptions& options);

/// Erases the landmarks that only one keyframe shows. Returns how many.
int cull_landmarks(Map& map);

/// Erases the redundant neighbours of the keyframe: more than redundant_share of the landmarks that they
/// share with others are seen by three other keyframes at about the same or a finer scale. The first keyframe
/// of a component stays. Returns the erased keyframes.
std::vector<KeyframeId> cull_keyframes(IndexedMap& indexed, KeyframeId keyframe,
                                       const MappingOptions& options);

}  // namespace cairn
