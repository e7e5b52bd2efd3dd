// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace cairn {

/// Writes the landmarks of the map in `map_folder` as a cloud: binary little-endian PLY with x y z as double,
/// red green blue as uchar, and std as float, which is the landmark's largest_std (metres). The colour tells
/// that on a logarithmic scale, from dark blue for 1 cm and less over red to orange for 1 m and more, as a
/// comment in the file says. Where the covariance was not computed it is grey, and std NaN. Memory does not
/// grow with the map. InputError where the map cannot be read or the file not be written.
void write_landmark_ply(const std::filesystem::path& map_folder, const std::filesystem::path& path);

}  // namespace cairn
