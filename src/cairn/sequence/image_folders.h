// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cairn/sequence/image_names.h"
#include "cairn/sequence/sequence.h"

namespace cairn {

/// Holds the images of one camera, or its depth images, as they were found.
struct ImageSide {
  std::string place;  ///< for people: "left/", "results/depth*", the pattern that was given
  std::vector<SeriesFile> files;
  std::string warning = {};  ///< of a place that was taken for another one; empty: none
};

/// Holds the two series of images that make the frames of a sequence.
struct ImagePair {
  bool is_stereo = false;
  ImageSide first;   ///< left or colour
  ImageSide second;  ///< right or depth
};

/// Finds the two series: those that the options name (`left` and `right`, `color` and `depth`, `rgb_dir` and
/// `depth_dir`), else the first of the usual names of folders and files of which both hold images. Throws
/// InputError where the options name one only, or nothing is there.
[[nodiscard]] std::optional<ImagePair> find_image_pair(const std::filesystem::path& folder,
                                                       const SequenceOptions& options);

/// Describes what a folder without any known layout nearly is: "left/ holds 40 images, right/ is missing".
/// Empty where nothing is near.
[[nodiscard]] std::string describe_nearest_layout(const std::filesystem::path& folder);

}  // namespace cairn
