// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "cairn/testing/core/temporary_folder.h"

namespace cairn::testkit {

/// Gives a fixture a small recording: texts and images of 8 x 6 pixels in a temporary folder. A base of
/// fixtures, beside testing::Test.
class RecordingFolder {
 protected:
  RecordingFolder() = default;
  ~RecordingFolder() = default;
  RecordingFolder(const RecordingFolder&) = delete;
  RecordingFolder& operator=(const RecordingFolder&) = delete;

  void make_empty() const { temporary_.clear(); }
  /// Writes the text file `name` and returns its path.
  [[nodiscard]] std::filesystem::path write(const std::string& name, const std::string& contents) const {
    return temporary_.write(name, contents);
  }
  /// Writes the text file `name`.
  void put(const std::string& name, const std::string& contents) const {
    (void)temporary_.write(name, contents);
  }
  /// Writes a colour image of one grey level.
  void put_color(const std::string& name, std::uint8_t gray = 90) const;
  /// Writes a depth image of one value.
  void put_depth(const std::string& name, std::uint16_t raw = 1000) const;

  const TemporaryFolder temporary_;
  const std::filesystem::path& folder_ = temporary_.path();
};

/// Holds camera.yaml for images of put_color and put_depth.
inline constexpr const char* kSmallCamera =
    "camera: {width: 8, height: 6, fx: 10, fy: 10, cx: 3.5, cy: 2.5}\ndepth: {scale: 1000}\n";

}  // namespace cairn::testkit
