// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "cairn/core/executor.h"
#include "cairn/map/map.h"
#include "cairn/map/pose_graph.h"
#include "cairn/optimize/camera_covariances.h"
#include "cairn/slam/window.h"

namespace cairn {

/// Holds how sure a keyframe is after the adjustment of its whole component: covariances of the motion to it
/// (camera_covariances), of the left perturbation of camera_from_first and so on, rotation in radians, then
/// position in metres, in the axes of this keyframe's camera.
struct KeyframeCovariance {
  /// Of the motion from the first keyframe of this sequence in the component, zero for that one; nullopt if
  /// it is not determined, or the keyframe is not of this sequence.
  std::optional<Matrix6d> from_first;
  /// Of the motion from the keyframe of this sequence before it; nullopt for the first one too.
  std::optional<Matrix6d> from_previous;
  std::optional<Matrix6d> from_parent;  ///< nullopt if the parent was erased too
};

/// Computes the covariances of the keyframes of an adjusted component from its observations with
/// `use_observation`, and stores each in `covariances`, by keyframe id.
void keep_keyframe_covariances(const Map& map, const Window& whole, std::span<const char> use_observation,
                               SharedField field, const Executor& executor,
                               std::vector<KeyframeCovariance>& covariances);

/// Converts the covariance of the motion from vertex a to vertex b of an edge, as KeyframeCovariance has it,
/// to the edge's information. Returns nullopt if the covariance is not positive definite.
[[nodiscard]] std::optional<Matrix6d> edge_information_of(const Matrix6d& covariance);

}  // namespace cairn
