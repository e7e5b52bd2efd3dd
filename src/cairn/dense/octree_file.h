// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

#include "cairn/dense/occupancy.h"

namespace cairn {

/// Names what an octree file holds.
enum class OctreeContents {
  binary,  ///< .bt: occupied, free or unknown (octomap::OcTree)
  plain,   ///< .ot: log odds (octomap::OcTree)
  color    ///< .ot: log odds and colour (octomap::ColorOcTree)
};

/// Describes the contents for people: "occupied and free", "probabilities", "probabilities and colours".
[[nodiscard]] std::string_view to_string(OctreeContents contents);

/// Returns the contents for an extension: .bt is binary; .ot is coloured if the map is, else plain. Throws
/// InputError for another extension.
[[nodiscard]] OctreeContents octree_contents(const std::filesystem::path& path, bool colored);

/// Describes a file that was written.
struct OctreeFileReport {
  std::int64_t nodes = 0;  ///< nodes of the pruned tree
  std::int64_t bytes = 0;
};

/// Writes the map as a pruned octree that OctoMap's own tools read. The file appears when it is complete.
/// Throws InputError if it cannot be written.
OctreeFileReport write_octree(const std::filesystem::path& path, const OccupancyGrid& grid,
                              OctreeContents contents);

}  // namespace cairn
