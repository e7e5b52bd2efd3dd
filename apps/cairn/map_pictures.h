// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "cairn/localize/localize_sequence.h"

namespace cairn::app {

/// Writes the picture of the map in `map_folder` to `folder`/landmarks.png.
void write_map_picture(const std::filesystem::path& map_folder, const std::filesystem::path& folder);
/// Writes the same with the poses that were found of images.
void write_found_picture(const std::filesystem::path& map_folder, const std::vector<LocalizedImage>& images,
                         const std::filesystem::path& folder);

}  // namespace cairn::app
