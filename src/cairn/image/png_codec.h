// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace cairn {

/// Holds an image as its file does, before it becomes one of the image types: samples interleaved, 16-bit
/// ones in the machine's byte order.
struct DecodedImage {
  int width = 0;
  int height = 0;
  int channels = 0;          ///< 1 or 3
  int bytes_per_sample = 0;  ///< 1 or 2
  std::vector<std::uint8_t> samples;
};

/// Tells whether a size is accepted; larger images are refused before memory is allocated for a broken
/// header.
[[nodiscard]] constexpr bool is_image_size(std::int64_t width, std::int64_t height) {
  constexpr std::int64_t kMaxSide = 32768, kMaxPixels = std::int64_t{1} << 28;
  return width > 0 && height > 0 && width <= kMaxSide && height <= kMaxSide && width * height <= kMaxPixels;
}
constexpr const char* kImageSizeLimit = "an image of at most 32768 pixels a side and 268 million in all";

/// Decodes a PNG held in memory; palettes and 1, 2, 4-bit grey become 8-bit, transparency is dropped.
/// Returns an empty string, or what is wrong with the file.
[[nodiscard]] std::string decode_png(std::string_view bytes, DecodedImage& image);

/// Encodes an image as a PNG in memory. Throws std::runtime_error if libpng fails.
[[nodiscard]] std::string encode_png(const DecodedImage& image);

}  // namespace cairn
