// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "cairn/image/image.h"

namespace cairn {

/// Decodes PNG, JPEG and binary PGM/PPM; the format follows from the file's first bytes, not its name. Throws
/// InputError if a file is missing, broken, of another format, or of a pixel type that does not fit.

/// Reads an image as 8-bit grey; converts colour to Rec. 601 luma.
[[nodiscard]] GrayImage read_gray(const std::filesystem::path& path);
/// Reads an image as 8-bit colour; repeats grey in the three channels.
[[nodiscard]] RgbImage read_rgb(const std::filesystem::path& path);
/// Reads a depth image of 16 bit and one channel (PNG or PGM). Throws InputError if it has 8 bit or colour.
[[nodiscard]] RawDepthImage read_depth(const std::filesystem::path& path);

/// Returns the size that the file's header states, without decoding. Throws InputError if the file is
/// missing, empty, of another format or, as far as its beginning and its end tell, truncated.
[[nodiscard]] ImageSize probe_image(const std::filesystem::path& path);

/// Writes a PNG file, complete or not at all (see AtomicFile).
void write_png(const std::filesystem::path& path, const GrayImage& image);
/// Writes a colour PNG file, complete or not at all.
void write_png(const std::filesystem::path& path, const RgbImage& image);
/// Writes a PNG file of 16 bit and one channel, complete or not at all.
void write_png(const std::filesystem::path& path, const RawDepthImage& image);

}  // namespace cairn
