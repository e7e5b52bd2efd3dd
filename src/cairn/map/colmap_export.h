// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace cairn {

/// Writes the map in `map_folder` as a sparse model of COLMAP's (Schoenberger & Frahm 2016) in its text form:
/// cameras.txt, images.txt and points3D.txt in `model_folder`, which is made where it does not exist. Memory
/// grows by 40 bytes a landmark and not with what the keyframes hold.
///
/// - One PINHOLE camera, the left one. COLMAP's pixels have their centres at .5: u, v, cx and cy are larger
/// by
///   that. Width and height are 0 where the map does not know them.
/// - Image number i + 1 is keyframe i, with all its features in their order. It is called NNNNNN.png by the
/// number of
///   its frame in the sequence, or of the keyframe where the map knows that of a keyframe no more: the map
///   does not know the names of the files. Poses are camera_from_world.
/// - Point number i + 1 is landmark i, grey. ERROR is the mean distance of pixel and projection, pixels; -1
/// where
///   a camera that shows it has it behind.
///
/// InputError for a map that cannot be read, or has parts without a common world.
void write_colmap_model(const std::filesystem::path& map_folder, const std::filesystem::path& model_folder);

}  // namespace cairn
