// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "cairn/map/held_out_frame.h"
#include "cairn/map_files/map_info.h"

namespace cairn {

/// Returns the contents of held_out.txt (docs/map_format.md): a comment with the names of the columns, then a
/// line for each frame.
[[nodiscard]] std::string format_held_out(std::span<const HeldOutFrame> frames);

/// Reads held_out.txt from the folder of a map; empty if the map has none. Throws InputError if the file is
/// damaged, does not fit map.json, or has a keyframe that the map does not have or a negative variance.
[[nodiscard]] std::vector<HeldOutFrame> read_held_out(const std::filesystem::path& folder,
                                                      const MapInfo& info);

}  // namespace cairn
