// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace cairn {

/// Generates random numbers that depend on nothing but (seed, stream): with a stream for every work item the
/// result is the same at any number of threads. SplitMix64 (Steele, Lea, Flood 2014).
class Random {
 public:
  explicit Random(std::uint64_t seed, std::uint64_t stream = 0);

  std::uint64_t next();                      ///< 64 uniform bits
  double uniform();                          ///< [0, 1)
  double uniform(double low, double high);   ///< [low, high)
  double normal();                           ///< mean 0, standard deviation 1
  std::uint32_t index(std::uint32_t count);  ///< [0, count), count > 0

 private:
  std::uint64_t state_;
};

}  // namespace cairn
