// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace cairn::app {

/// Reads the map in a folder that find_map_folder finds, which checks all of it, and prints its figures.
void print_map_info(const std::filesystem::path& folder, bool json);

}  // namespace cairn::app
