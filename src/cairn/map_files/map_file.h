// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "cairn/map/map.h"

namespace cairn {

/// Writes the map as a folder; docs/map_format.md has its layout, with a reader in Python. What is erased is
/// left out, and the rest numbered from 0. `covariances` are of the landmarks' points in the world, square
/// metres, one for each of Map::landmarks() (that of an erased one does not matter); empty: zeros are
/// written. Variances may be infinite, of points that nothing determines (point_covariances). The folder
/// appears when it is complete.
///
/// Throws PreconditionError unless the map has a keyframe, its descriptors are of one kind whose name is one
/// of descriptor_names(), observations and points are finite, and no covariance has a NaN. Throws InputError
/// if the folder cannot be written or must not be replaced, see OutputFolder.
void write_map(const std::filesystem::path& folder, const Map& map,
               std::span<const Eigen::Matrix3d> covariances = {});

/// Returns the folder of the map: `folder` itself or, for that of a run, its `map/`. Returns nullopt if
/// neither has a file of a map; does not check that it can be read.
[[nodiscard]] std::optional<std::filesystem::path> find_map_folder(const std::filesystem::path& folder);

/// Returns the folder of the map as find_map_folder does. Throws InputError if there is none.
[[nodiscard]] std::filesystem::path require_map_folder(const std::filesystem::path& folder);

/// Reads the map in a folder that find_map_folder finds. Writing it gives the same bytes, if the same
/// covariances are given. Observations have the precision of floats, keypoints no response; a keyframe's
/// parent is the earlier one of its component that shows most of the same landmarks (the latest of several;
/// if none shows any, the one before it). Throws InputError that names the file if one is missing, damaged,
/// of another version, or does not fit the others.
[[nodiscard]] Map read_map(const std::filesystem::path& folder);

/// Reads the covariances of the points of the landmarks, square metres, by their ids; zero if they were not
/// given. Throws InputError if map.json or Point.bin cannot be read.
[[nodiscard]] std::vector<Eigen::Matrix3d> read_covariances(const std::filesystem::path& folder);

}  // namespace cairn
