// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "cairn/core/executor.h"
#include "cairn/core/progress.h"
#include "cairn/sequence/sequence.h"

namespace cairn {

/// Writes the map in `map_folder`, which was made of `sequence`, as a sparse model of COLMAP (Schoenberger &
/// Frahm 2016), text and binary (ColmapWriter), into `model_folder`, which is made if it does not exist.
/// Memory does not grow with the map, but for what map.json holds of each keyframe; a file of 32 bytes a
/// feature lies in `model_folder` meanwhile. The same bytes at any number of threads.
///
/// The model is of the images on disk, which COLMAP finds with `--image_path` colmap_image_root(sequence):
///
/// - Camera 1 took the left (or colour) images and camera 2 the right ones, as they were recorded: with
///   their distortion, and before rectification.
/// - Image 2 i + 1 is the left and image 2 i + 2 the right one of keyframe i; of RGB-D, image i + 1 is the
///   colour one. Names are colmap_image_name. Each has the keyframe's features as pixels of the image on
///   disk, those of the right image by their disparities; a feature without one is not in the right image.
/// - Point i + 1 is landmark i. Its colour is the median, for each channel, of the left images' colours at
///   its observations. ERROR is the mean distance of pixel and projection by the poses of the model; -1 if
///   it lies behind a camera.
///
/// Throws InputError for a map that cannot be read, has components without a common world, or is not of this
/// sequence, for an image that cannot be read, and for a name with blanks (colmap_image_name).
void write_colmap_model(const std::filesystem::path& map_folder, const Sequence& sequence,
                        const std::filesystem::path& model_folder, const Executor& executor,
                        Progress& progress);

}  // namespace cairn
