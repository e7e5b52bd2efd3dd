// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "cairn/map_files/map_statistics.h"

namespace cairn {

/// Returns the figures of the map in `folder`, with a table of how good its landmarks are, for people.
[[nodiscard]] std::string format_map_text(const std::filesystem::path& folder, const MapStatistics& figures);
/// Returns the same as a JSON object, numbers in full.
[[nodiscard]] std::string format_map_json(const std::filesystem::path& folder, const MapStatistics& figures);

}  // namespace cairn
