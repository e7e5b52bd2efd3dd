// SPDX-License-Identifier: Apache-2.0
#include "map_pictures.h"

#include "cairn/image/codec.h"
#include "cairn/report/landmark_picture.h"

namespace cairn::app {

void write_map_picture(const std::filesystem::path& map_folder, const std::filesystem::path& folder) {
  write_png(folder / kMapPicture, draw_landmarks(map_folder));
}

void write_found_picture(const std::filesystem::path& map_folder, const std::vector<LocalizedImage>& images,
                         const std::filesystem::path& folder) {
  std::vector<FoundPose> found;
  std::int64_t not_found = 0;
  for (const LocalizedImage& image : images) {
    if (!image.found.found())
      ++not_found;
    else
      found.push_back({image.found.camera_from_world.inverse(), image.found.verdict == Verdict::good});
  }
  write_png(folder / kMapPicture, draw_found_poses(map_folder, found, not_found));
}

}  // namespace cairn::app
