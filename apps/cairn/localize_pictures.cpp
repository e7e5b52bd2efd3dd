// SPDX-License-Identifier: Apache-2.0
#include "localize_pictures.h"

#include <fmt/format.h>

#include <algorithm>

#include "cairn/core/file.h"
#include "cairn/image/codec.h"
#include "cairn/report/localization_picture.h"

namespace cairn::app {
namespace {

/// Of a point in the camera, in the image as it is stored; far away where it is not in the image.
Eigen::Vector2d pixel_of(const Camera& camera, const Eigen::Vector3d& point_in_camera) {
  constexpr double kNowhere = -1e4;
  return camera.project(point_in_camera).value_or(Eigen::Vector2d::Constant(kNowhere));
}

std::vector<DrawnMatch> drawn(const Localization& found, const Camera& camera, const Rig& rig) {
  std::vector<DrawnMatch> matches;
  for (std::size_t i = 0; i < found.matches.size(); ++i) {
    const LandmarkMatch& match = found.matches[i];
    const Eigen::Vector2d seen = pixel_of(camera, rig.point_at(match.seen.u, match.seen.v, 1.0));
    const bool inlier =
        std::binary_search(found.inliers.begin(), found.inliers.end(), static_cast<std::int32_t>(i));
    const Eigen::Vector2d projected =
        found.found() ? pixel_of(camera, found.camera_from_world * match.point_in_world) : seen;
    matches.push_back({seen, projected, inlier});
  }
  return matches;
}

}  // namespace

void draw_pictures(const std::filesystem::path& folder, const Sequence& sequence, const QueryCamera& camera,
                   const std::vector<LocalizedImage>& images) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) fail_writing(folder, "make the folder", error.value());
  const FrameLoader loader(sequence);
  for (const LocalizedImage& image : images) {
    const Frame frame = loader.load({static_cast<std::int32_t>(image.position)});
    const auto matches = drawn(image.found, sequence.calibration.camera, camera.rig);
    write_png(folder / fmt::format("{:06}.png", image.position), draw_localization(frame.gray, matches));
  }
}

}  // namespace cairn::app
