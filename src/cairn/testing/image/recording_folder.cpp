// SPDX-License-Identifier: Apache-2.0
#include "cairn/testing/image/recording_folder.h"

#include "cairn/image/codec.h"
#include "cairn/image/image.h"

namespace cairn::testkit {

void RecordingFolder::put_color(const std::string& name, std::uint8_t gray) const {
  std::filesystem::create_directories((folder_ / name).parent_path());
  write_png(folder_ / name, RgbImage(8, 6, {gray, gray, gray}));
}

void RecordingFolder::put_depth(const std::string& name, std::uint16_t raw) const {
  std::filesystem::create_directories((folder_ / name).parent_path());
  write_png(folder_ / name, RawDepthImage(8, 6, raw));
}

}  // namespace cairn::testkit
