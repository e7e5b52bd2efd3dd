// SPDX-License-Identifier: Apache-2.0
#include "cairn/map_files/colmap_sources.h"

#include <algorithm>
#include <cctype>

#include "cairn/core/error.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;

/// Returns the absolute path without "." and "..", and without a separator at its end.
fs::path plain(const fs::path& path) {
  const fs::path normal = fs::absolute(path).lexically_normal();
  return normal.has_filename() ? normal : normal.parent_path();
}

bool is_below(const fs::path& path, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

}  // namespace

RecordedRig recorded_rig(const Sequence& sequence) {
  const Calibration& calibration = sequence.calibration;
  RecordedRig rig{{calibration.camera, Eigen::Quaterniond::Identity()}, {}, calibration.baseline.value_or(0)};
  if (is_stereo(sequence)) rig.right = rig.left;
  if (!calibration.raw_stereo) return rig;
  const auto& [pair, rectification] = *calibration.raw_stereo;
  rig.left = {pair.left, rectification.rectified_from_left.conjugate()};
  if (rig.right) rig.right = {pair.right, rectification.rectified_from_right.conjugate()};
  return rig;
}

fs::path colmap_image_root(const Sequence& sequence) {
  fs::path root = plain(sequence.folder);
  for (const FrameFiles& files : sequence.frames)
    for (const fs::path& image : {files.color, files.right})
      while (!image.empty() && !is_below(plain(image), root)) root = root.parent_path();
  return root;
}

std::string colmap_image_name(const fs::path& root, const fs::path& image) {
  std::string name = plain(image).lexically_relative(root).generic_string();
  if (std::any_of(name.begin(), name.end(), [](unsigned char c) { return std::isspace(c) != 0; }))
    throw InputError({image.string(), 0, "names of images without blanks, as COLMAP's texts end them there",
                      "'" + name + "'", "Rename the images, or map without --export colmap."});
  return name;
}

void check_colmap_names(const Sequence& sequence) {
  const fs::path root = colmap_image_root(sequence);
  for (const FrameFiles& files : sequence.frames) {
    (void)colmap_image_name(root, files.color);
    if (!files.right.empty()) (void)colmap_image_name(root, files.right);
  }
}

}  // namespace cairn
