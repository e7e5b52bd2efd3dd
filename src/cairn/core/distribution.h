// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>

namespace cairn {

/// Describes the distribution of any number of values in bounded memory: they are counted in bins whose width
/// is a thousandth of the value, as in DDSketch (Masson, Rim & Lee 2019). The mean is summed in the order of
/// the values.
class Distribution {
 public:
  /// Adds a value, which must not be NaN.
  void add(double value);
  [[nodiscard]] std::uint64_t count() const { return count_; }
  /// Returns the exact smallest value. Throws PreconditionError if there are no values.
  [[nodiscard]] double min() const;
  /// Returns the exact largest value. Throws PreconditionError if there are no values.
  [[nodiscard]] double max() const;
  /// Returns the mean, summed in the order of the values. Throws PreconditionError if there are no values.
  [[nodiscard]] double mean() const;
  /// Returns the value that `share` (0 to 1) of the values do not exceed: the mean of those in its bin, so
  /// that its relative error is at most a thousandth; exact if all values of the bin are equal, as for small
  /// whole numbers. Throws PreconditionError if there are no values.
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
