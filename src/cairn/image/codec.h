// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "cairn/image/image.h"

namespace cairn {

/// Decoding of PNG, JPEG and binary PGM/PPM; the format is taken from the file's first bytes, not its name.
/// InputError for a file that is missing, broken, of another format, or of a pixel type that does not fit.

/// 8-bit grey; colour is converted (Rec. 601 luma).
[[nodiscard]] GrayImage read_gray(const std::filesystem::path& path);
/// 8-bit colour; grey is spread over the three channels.
[[nodiscard]] RgbImage read_rgb(const std::filesystem::path& path);
/// 16-bit single channel (PNG or PGM). An 8-bit or colour image is an InputError: it is no depth image.
[[nodiscard]] RawDepthImage read_depth(const std::filesystem::path& path);

/// Width and height of an image.
struct ImageSize {
  int width = 0, height = 0;
  bool operator==(const ImageSize&) const = default;
};
/// The size that the file's header says, without decoding. InputError for a file that is missing, empty, of
/// another format or cut, as far as its beginning and its end tell.
[[nodiscard]] ImageSize probe_image(const std::filesystem::path& path);

/// PNG files, complete or not there at all (see AtomicFile).
void write_png(const std::filesystem::path& path, const GrayImage& image);
void write_png(const std::filesystem::path& path, const RgbImage& image);
void write_png(const std::filesystem::path& path, const RawDepthImage& image);

}  // namespace cairn
