// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace cairn {

/// An image as its file holds it, before it becomes one of the image types: samples interleaved, 16-bit ones
/// in the machine's byte order.
struct DecodedImage {
  int width = 0;
  int height = 0;
  int channels = 0;          ///< 1 or 3
  int bytes_per_sample = 0;  ///< 1 or 2
  std::vector<std::uint8_t> samples;
};

/// Decodes a PNG held in memory; palettes and 1, 2, 4-bit grey become 8-bit, transparency is dropped.
/// Returns an empty string, or what is wrong with the file.
[[nodiscard]] std::string decode_png(std::string_view bytes, DecodedImage& image);

/// Encodes; `samples` as in DecodedImage. Throws std::runtime_error where libpng fails.
[[nodiscard]] std::string encode_png(const DecodedImage& image);

}  // namespace cairn
