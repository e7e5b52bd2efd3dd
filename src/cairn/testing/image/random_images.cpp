// SPDX-License-Identifier: Apache-2.0
#include "cairn/testing/image/random_images.h"

#include <algorithm>

#include "cairn/core/random.h"

namespace cairn::testkit {

GrayImage random_image(int width, int height, std::uint64_t seed) {
  Random random(seed);
  GrayImage image(width, height);
  for (std::size_t i = 0; i < image.size(); ++i)
    image.data()[i] = static_cast<std::uint8_t>(random.index(256));
  return image;
}

GrayImage blocky_image(int width, int height, std::uint64_t seed) {
  Random random(seed);
  GrayImage image(width, height, 100);
  for (int i = 0; i < width * height / 40; ++i) {
    const int u0 = static_cast<int>(random.index(static_cast<std::uint32_t>(width)));
    const int v0 = static_cast<int>(random.index(static_cast<std::uint32_t>(height)));
    const auto value = static_cast<std::uint8_t>(20 * random.index(13));
    const int side = 1 + static_cast<int>(random.index(8));
    for (int v = v0; v < std::min(height, v0 + side); ++v)
      for (int u = u0; u < std::min(width, u0 + side); ++u) image(u, v) = value;
  }
  return image;
}

}  // namespace cairn::testkit
