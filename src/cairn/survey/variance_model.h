// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace cairn {

/// The a-posteriori variance factor of landmarks: how much noisier their observations are than their sigmas
/// say. A landmark's own, s^2 = squared_error_sum / redundancy, is a poor estimate from three or four frames,
/// and would make most landmarks look surer than they are; that of all together ignores that some are
/// blurred. In between: the factors of the landmarks seen so far have a scaled inverse chi-square
/// distribution with d0 degrees of freedom and scale s0^2, estimated from the mean and variance of log s^2
/// (Smyth 2004, Linear models and empirical Bayes methods, sec. 6.2); given that, the point's errors have a t
/// distribution with d0 + r degrees of freedom, whose covariance is the cofactor times
///
///     (d0 s0^2 + r s^2) / (d0 + r - 2).
struct VariancePrior {
  double freedom = 4;  ///< d0
  double scale = 1;    ///< s0^2

  [[nodiscard]] double factor(double squared_error_sum, int redundancy) const {
    return (freedom * scale + squared_error_sum) / (freedom + redundancy - 2);
  }
};

/// Learns the prior from landmarks.
class VarianceModel {
 public:
  /// One more landmark. `redundancy` at least 1.
  void add(double squared_error_sum, int redundancy);
  [[nodiscard]] VariancePrior prior() const;

  /// All that it remembers, for storing it.
  struct Sums {
    std::int64_t count = 0;
    double log = 0, log_squared = 0;  ///< of e = log s^2 - digamma(r/2) + log(r/2)
    double noise = 0;                 ///< of trigamma(r/2)
  };
  VarianceModel() = default;
  explicit VarianceModel(const Sums& sums) : sums_(sums) {}
  [[nodiscard]] const Sums& sums() const { return sums_; }

 private:
  Sums sums_;
};

/// Derivatives of log Gamma at x above 0.
[[nodiscard]] double digamma(double x);
[[nodiscard]] double trigamma(double x);
/// The x where trigamma(x) = `value`, above 0.
[[nodiscard]] double inverse_trigamma(double value);

}  // namespace cairn
