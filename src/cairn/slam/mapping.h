// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cairn/slam/frame_pose.h"
#include "cairn/slam/indexed_map.h"

namespace cairn {

// What a new keyframe brings to the map, one step each; all deterministic.

/// Adds a keyframe, which shows the landmarks that its frame was tracked by.
KeyframeId add_keyframe(IndexedMap& indexed, const ObservedFrame& observed, const FramePose& tracked,
                        KeyframeId parent, std::int32_t component);

/// Each feature with depth that shows no landmark becomes one. Returns how many.
int add_landmarks_by_depth(Map& map, KeyframeId keyframe);

/// Looks for the landmarks of the keyframe in its neighbours, and for theirs in it: what is found becomes a
/// observation, and two landmarks at one feature become one. Returns how many were joined or found.
int fuse_with_neighbours(Map& map, KeyframeId keyframe, const SlamOptions& options);

/// The same between two keyframes that see one place, each with its neighbours.
int fuse_neighbourhoods(Map& map, KeyframeId a, KeyframeId b, const SlamOptions& options);

/// Erases the landmarks that one keyframe only shows. Returns how many.
int cull_landmarks(Map& map);

/// Erases neighbours of the keyframe, except the first of a component, whose landmarks are nearly all seen by
/// three other keyframes at the same or a finer scale. Returns those erased.
std::vector<KeyframeId> cull_keyframes(IndexedMap& indexed, KeyframeId keyframe,
                                       const MappingOptions& options);

}  // namespace cairn
