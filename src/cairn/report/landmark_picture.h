// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "cairn/geometry/framed.h"
#include "cairn/image/image.h"

namespace cairn {

/// Names the picture from above in the folder of a map or a run.
constexpr const char* kLandmarkPicture = "landmarks.png";

/// Draws the map in `map_folder` (or the run folder that has it in its map/) from above: its landmarks in the
/// colours of their standard deviations, with the scale of these (std_rgb), and the path of its keyframes
/// with start and end; a bar of a round length in metres, and which directions of the world are right and up
/// (choose_plan_axes). The extent is that of the path and of all but the outermost hundredths of the
/// landmarks in either direction; those whose standard deviation is above 1 m count only if nearly all are
/// such. Of a map of several components the one with most keyframes is drawn, as components have no common
/// world.
///
/// The landmarks are read twice and never kept: memory does not grow with their number. InputError if the map
/// cannot be read.
[[nodiscard]] RgbImage draw_landmarks(const std::filesystem::path& map_folder);

/// A pose that was found in a map.
struct FoundPose {
  WorldFromCamera world_from_camera;
  bool good = false;  ///< else weak
};

/// Draws the same with the landmarks in grey and, instead of start and end, the poses that were found in the
/// map as dots, each with a line where it looks: good ones green, weak ones orange. The extent includes the
/// good ones. `not_found` is the number of images without a pose, for the legend.
[[nodiscard]] RgbImage draw_found_poses(const std::filesystem::path& map_folder,
                                        const std::vector<FoundPose>& found, std::int64_t not_found);

}  // namespace cairn
