// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "cairn/dense/cloud.h"
#include "cairn/dense/fuse_sequence.h"
#include "cairn/dense/occupancy.h"
#include "cairn/dense/octree_file.h"

namespace cairn {

/// Holds what is told of a cloud that was made of a sequence.
struct CloudReport {
  std::string output, picture;  ///< files, as the user named them; no picture: none was drawn
  FusionReport fusion;
  std::size_t points = 0;
  double voxel_m = 0;
  CloudBounds bounds;
  std::int64_t bytes = 0;  ///< of the file
  double seconds = 0;
};

/// Returns frames, points, extent and file of a cloud, for people.
[[nodiscard]] std::string format_cloud_text(const CloudReport& report);
/// Returns the same as a JSON object, numbers in full.
[[nodiscard]] std::string format_cloud_json(const CloudReport& report);

/// Holds what is told of an octree.
struct OctreeReport {
  std::string output;                  ///< file, as the user named it
  std::optional<FusionReport> fusion;  ///< nothing: made of a cloud
  std::size_t points = 0;              ///< of that cloud
  double resolution_m = 0;
  OctreeContents contents = OctreeContents::binary;
  OctreeFileReport file;
  OccupancyGrid::Counts counts;
  double seconds = 0;
};

/// Returns frames or points, voxels and file of an octree, for people.
[[nodiscard]] std::string format_octree_text(const OctreeReport& report);
/// Returns the same as a JSON object, numbers in full.
[[nodiscard]] std::string format_octree_json(const OctreeReport& report);

/// Returns a size as "999 bytes", "1.5 kB" or "1.5 MB".
[[nodiscard]] std::string format_bytes(std::int64_t bytes);

}  // namespace cairn
