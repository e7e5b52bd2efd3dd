// SPDX-License-Identifier: Apache-2.0
// A small map with all that a map can hold.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "cairn/core/random.h"
#include "cairn/map/map.h"

namespace cairn::testkit {

inline constexpr Rig kSceneRig{525, 520, 319.5, 239.5, 0.075};

/// Returns the message of read_map's InputError, with MAP for the folder, or "no error".
[[nodiscard]] std::string message_for(const std::filesystem::path& folder);

/// Returns a frame whose feature i shows point i, each third without a disparity.
[[nodiscard]] ObservedFrame observe_points(const std::vector<Eigen::Vector3d>& points_in_world,
                                           const Rigid3& world_from_camera, std::size_t descriptor_bytes,
                                           Random& random);

/// Returns five keyframes of two parts, the third erased; ten landmarks, two of them erased, seen by three
/// keyframes at most. Descriptors of 61 bytes, as AKAZE's, are no multiple of 8.
[[nodiscard]] Map scene_map();

/// Returns a covariance for each landmark, also for erased ones: positive definite and all different.
[[nodiscard]] std::vector<Eigen::Matrix3d> scene_covariances(const Map& map);

}  // namespace cairn::testkit
