// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "cairn/core/error.h"

namespace cairn {

/// Holds width and height of an image, pixels.
struct ImageSize {
  int width = 0, height = 0;
  bool operator==(const ImageSize&) const = default;
};

/// Holds a dense image, row by row without padding. Pixel (0, 0) is the top left.
template <class Pixel>
class Image {
 public:
  Image() = default;
  Image(int width, int height, const Pixel& fill = Pixel{}) : width_(width), height_(height) {
    require(width >= 0 && height >= 0, "an image has no negative size");
    pixels_.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), fill);
  }

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] bool empty() const { return pixels_.empty(); }
  /// Returns the pixel in column u, [0, width), and row v, [0, height); not checked.
  [[nodiscard]] Pixel& operator()(int u, int v) { return row(v)[u]; }
  [[nodiscard]] const Pixel& operator()(int u, int v) const { return row(v)[u]; }
  [[nodiscard]] Pixel* row(int v) { return pixels_.data() + offset(v); }
  [[nodiscard]] const Pixel* row(int v) const { return pixels_.data() + offset(v); }
  [[nodiscard]] Pixel* data() { return pixels_.data(); }
  [[nodiscard]] const Pixel* data() const { return pixels_.data(); }
  [[nodiscard]] std::size_t size() const { return pixels_.size(); }
  /// Tells whether column u and row v lie in the image.
  [[nodiscard]] bool contains(int u, int v) const { return u >= 0 && v >= 0 && u < width_ && v < height_; }
  bool operator==(const Image&) const = default;

 private:
  [[nodiscard]] std::size_t offset(int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(width_);
  }

  int width_ = 0;
  int height_ = 0;
  std::vector<Pixel> pixels_;
};

/// Holds a colour of 8 bit per channel.
struct Rgb8 {
  std::uint8_t r = 0, g = 0, b = 0;
  bool operator==(const Rgb8&) const = default;
};

using GrayImage = Image<std::uint8_t>;
using RgbImage = Image<Rgb8>;
using RawDepthImage = Image<std::uint16_t>;  ///< depth as stored, in the sensor's units
using DepthImage = Image<float>;             ///< metres along the optical axis; 0 if unknown

}  // namespace cairn
