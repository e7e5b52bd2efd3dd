// SPDX-License-Identifier: Apache-2.0
#include "localize_pictures.h"

#include <fmt/format.h>

#include "cairn/core/file.h"
#include "cairn/image/codec.h"
#include "cairn/report/localization_picture.h"
#include "cairn/report/localization_report.h"

namespace cairn::app {
void draw_pictures(const std::filesystem::path& folder, const Sequence& sequence, const QueryCamera& camera,
                   const std::vector<LocalizedImage>& images) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) fail_writing(folder, "make the folder", error.value());
  const FrameLoader loader(sequence);
  for (const LocalizedImage& image : images) {
    const Frame frame = loader.load({static_cast<std::int32_t>(image.position)});
    const auto matches = drawn_matches(image.found, sequence.calibration.camera, camera.rig);
    write_png(folder / fmt::format("{:06}.png", image.position), draw_localization(frame.gray, matches));
  }
}

}  // namespace cairn::app
