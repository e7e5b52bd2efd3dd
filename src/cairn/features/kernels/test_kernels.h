// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "cairn/core/random.h"
#include "cairn/features/kernels/available.h"
#include "cairn/image/image.h"

namespace cairn {

/// A test that runs once for each instruction set of this machine.
class EachInstructionSet : public testing::TestWithParam<InstructionSet> {};

inline std::string name_of_parameter(const testing::TestParamInfo<InstructionSet>& tested) {
  std::string name(name_of(tested.param));
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
}

inline GrayImage random_image(int width, int height, std::uint64_t seed) {
  Random random(seed);
  GrayImage image(width, height);
  for (std::size_t i = 0; i < image.size(); ++i)
    image.data()[i] = static_cast<std::uint8_t>(random.index(256));
  return image;
}

/// Few grey levels in patches, so that corners, ties and plain ground all occur.
inline GrayImage blocky_image(int width, int height, std::uint64_t seed) {
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

}  // namespace cairn
