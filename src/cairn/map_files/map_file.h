// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "cairn/map/map.h"

namespace cairn {

/// Writes the map as a folder, whose layout, with a reader in Python, is docs/map_format.md. What is erased
/// is left out, and the rest numbered from 0. `covariances` are of the landmarks' points in the world, square
/// metres, one for each of Map::landmarks() (an erased one's does not matter), or none: then zeros are
/// written. Variances may be infinite, as point_covariances has them where nothing determines a point. The
/// folder appears when it is complete.
///
/// The map has a keyframe; its descriptors are of one kind, whose name is one of descriptor_names();
/// observations and points are finite, no covariance has a NaN. InputError where the folder cannot be written
/// or is one that must not be replaced, see OutputFolder.
void write_map(const std::filesystem::path& folder, const Map& map,
               std::span<const Eigen::Matrix3d> covariances = {});

/// The folder of the map that `folder` is or, as a run, has in its `map/`; nothing where there is none. Says
/// nothing of whether it can be read.
[[nodiscard]] std::optional<std::filesystem::path> find_map_folder(const std::filesystem::path& folder);

/// The same; InputError where there is none.
[[nodiscard]] std::filesystem::path require_map_folder(const std::filesystem::path& folder);

/// The map in a folder that find_map_folder finds. Writing it gives the same bytes, if the same covariances
/// are given. Observations have the precision of floats, keypoints no response; a keyframe's parent is the
/// earlier one of its component that shows most of the same landmarks (the latest of several, the one before
/// it where none shows any). InputError names the file where one is missing, damaged, of another version, or
/// does not fit the others.
[[nodiscard]] Map read_map(const std::filesystem::path& folder);

/// The covariances of that map's landmarks, by their ids; zero where they were not given. InputError as
/// read_map.
[[nodiscard]] std::vector<Eigen::Matrix3d> read_covariances(const std::filesystem::path& folder);

}  // namespace cairn
