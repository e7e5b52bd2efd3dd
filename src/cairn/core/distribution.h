// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>

namespace cairn {

/// How values are distributed, of any number of them in bounded memory: they are counted in bins whose width
/// is a thousandth of the value, as in DDSketch (Masson, Rim & Lee 2019). The mean is summed in the order of
/// the values.
class Distribution {
 public:
  /// Not NaN.
  void add(double value);
  [[nodiscard]] std::uint64_t count() const { return count_; }
  /// These are exact. PreconditionError where no value was added, for the others, too.
  [[nodiscard]] double min() const;
  [[nodiscard]] double max() const;
  [[nodiscard]] double mean() const;
  /// The value that `share` (0 to 1) of the values are at most: the mean of those in its bin, so that it is
  /// off by a thousandth at most, and exact where all values there are the same, as small whole numbers are.
  [[nodiscard]] double quantile(double share) const;

 private:
  struct Bin {
    std::uint64_t count = 0;
    double sum = 0;
  };
  std::map<std::int64_t, Bin> bins_;  // by bin_of
  std::uint64_t count_ = 0;
  double sum_ = 0, min_ = 0, max_ = 0;
};

}  // namespace cairn
