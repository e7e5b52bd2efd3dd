// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "cairn/geometry/framed.h"
#include "cairn/map_files/map_info.h"

namespace cairn {

/// Throws InputError unless the file `name` in the folder of a map is the one that map.json names, by its
/// CRC-32.
void check_map_text(const std::filesystem::path& folder, const MapInfo& info, const char* name);

/// Reads the poses of the keyframes from poses.txt; their stamps need not increase, as a map may hold several
/// recordings. Throws InputError if they do not fit map.json.
[[nodiscard]] std::vector<WorldFromCamera> read_map_poses(const std::filesystem::path& folder,
                                                          const MapInfo& info);

}  // namespace cairn
