// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "cairn/map/map.h"

namespace cairn {

/// Writes the map into `folder`, which it makes: map.json (what it is, calibration, counts), poses.txt
/// (world_from_camera of each keyframe, TUM format) and frames/NNNNNN.<descriptor> (pixels, disparities and
/// descriptors, named by the position of the frame in its sequence). The layout, with a reader in Python, is
/// docs/map_format.md.
void write_map(const std::filesystem::path& folder, const Map& map);

/// The contents of one frames/ file.
[[nodiscard]] std::string format_frame_file(const Keyframe& keyframe);

}  // namespace cairn
