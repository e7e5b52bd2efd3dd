// SPDX-License-Identifier: Apache-2.0
#include "cairn/testing/image/textured_pair.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cairn/core/random.h"

namespace cairn::testkit {

Waves::Waves(double shortest_px, double contrast, std::uint64_t seed) {
  constexpr int kWaves = 30;
  Random random(seed);
  const double highest = 2 * std::numbers::pi / shortest_px;
  for (int i = 0; i < kWaves; ++i)
    waves_.push_back({random.uniform(-highest, highest), random.uniform(-highest, highest),
                      random.uniform(0, 2 * std::numbers::pi), contrast * std::sqrt(2.0 / kWaves)});
}

double Waves::at(double x, double y) const {
  double level = 0;
  for (const Wave& wave : waves_) level += wave.height * std::cos(wave.x * x + wave.y * y + wave.phase);
  return level;
}

std::uint8_t to_gray(double level) {
  return static_cast<std::uint8_t>(std::clamp(std::lround(level), 0L, 255L));
}

TestPair make_pair(int width, int height, const Surface& surface, const Waves& waves, double gain,
                   double deviation) {
  TestPair pair{GrayImage(width, height), GrayImage(width, height)};
  Random random(17);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      const double disparity = surface.disparity(pair.left, u, v);
      pair.left(u, v) = to_gray(110 + waves.at(u - disparity, v) + deviation * random.normal());
      pair.right(u, v) = to_gray(gain * (110 + waves.at(u, v)) + deviation * random.normal());
    }
  }
  return pair;
}

}  // namespace cairn::testkit
