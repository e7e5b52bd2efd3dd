// SPDX-License-Identifier: Apache-2.0
#include "cairn/core/distribution.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "cairn/core/error.h"

namespace cairn {
namespace {

/// The exponent and ten bits of the fraction: increases with the value, 1024 bins from each power of two to
/// the next.
std::int64_t bin_of(double value) {
  constexpr int kDroppedBits = 52 - 10;
  const auto magnitude =
      static_cast<std::int64_t>(std::bit_cast<std::uint64_t>(std::abs(value)) >> kDroppedBits);
  return value < 0 ? -magnitude : magnitude;
}

}  // namespace

void Distribution::add(double value) {
  require(!std::isnan(value), "a value to count is a number");
  min_ = count_ == 0 ? value : std::min(min_, value);
  max_ = count_ == 0 ? value : std::max(max_, value);
  sum_ += value;
  ++count_;
  Bin& bin = bins_[bin_of(value)];
  bin.sum += value;
  ++bin.count;
}

double Distribution::min() const {
  require(count_ > 0, "a distribution has values");
  return min_;
}

double Distribution::max() const {
  require(count_ > 0, "a distribution has values");
  return max_;
}

double Distribution::mean() const {
  require(count_ > 0, "a distribution has values");
  return sum_ / static_cast<double>(count_);
}

double Distribution::quantile(double share) const {
  require(count_ > 0, "a distribution has values");
  require(share >= 0 && share <= 1, "a quantile is of a share from 0 to 1");
  const double rank = std::max(1.0, std::ceil(share * static_cast<double>(count_)));
  std::uint64_t counted = 0;
  for (const auto& [number, bin] : bins_) {
    counted += bin.count;
    if (static_cast<double>(counted) >= rank)
      return std::clamp(bin.sum / static_cast<double>(bin.count), min_, max_);
  }
  return max_;
}

}  // namespace cairn
