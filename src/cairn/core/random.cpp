// SPDX-License-Identifier: Apache-2.0
#include "cairn/core/random.h"

#include <cmath>
#include <numbers>

#include "cairn/core/error.h"

namespace cairn {
namespace {

std::uint64_t mix(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

constexpr std::uint64_t kGoldenGamma = 0x9e3779b97f4a7c15ULL;

}  // namespace

Random::Random(std::uint64_t seed, std::uint64_t stream)
    : state_(mix(seed + kGoldenGamma) ^ mix(mix(stream) + kGoldenGamma)) {}

std::uint64_t Random::next() {
  state_ += kGoldenGamma;
  return mix(state_);
}

double Random::uniform() {
  return static_cast<double>(next() >> 11) * 0x1.0p-53;
}

double Random::uniform(double low, double high) {
  return low + (high - low) * uniform();
}

double Random::normal() {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
  return radius * std::cos(2.0 * std::numbers::pi * uniform());
}

std::uint32_t Random::index(std::uint32_t count) {
  require(count > 0, "a random index needs a count above 0");
  return static_cast<std::uint32_t>(((next() >> 32) * count) >> 32);
}

}  // namespace cairn
