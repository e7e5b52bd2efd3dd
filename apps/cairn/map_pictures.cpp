// SPDX-License-Identifier: Apache-2.0
#include "map_pictures.h"

#include <cstdint>

#include "cairn/image/codec.h"
#include "cairn/report/landmark_picture.h"
#include "cairn/report/localization_report.h"

namespace cairn::app {

void write_map_picture(const std::filesystem::path& map_folder, const std::filesystem::path& folder) {
  write_png(folder / kLandmarkPicture, draw_landmarks(map_folder));
}

void write_found_picture(const std::filesystem::path& map_folder, const std::vector<LocalizedImage>& images,
                         const std::filesystem::path& folder) {
  const std::vector<FoundPose> found = found_poses(images);
  const auto not_found = static_cast<std::int64_t>(images.size() - found.size());
  write_png(folder / kLandmarkPicture, draw_found_poses(map_folder, found, not_found));
}

}  // namespace cairn::app
