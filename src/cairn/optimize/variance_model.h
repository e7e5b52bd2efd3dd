// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace cairn {

/// Holds the prior of the landmarks' a-posteriori variance factor: how much noisier their observations are
/// than their standard deviations say. A landmark's own factor, s^2 = squared_error_sum / redundancy, is a
/// poor estimate from three or four frames, and would make most landmarks look too certain; the factor of all
/// together ignores that some are blurred. In between: the factors of the landmarks seen so far have a scaled
/// inverse chi-square distribution with d0 degrees of freedom and scale s0^2, estimated from the mean and
/// variance of log s^2 (Smyth 2004, Linear models and empirical Bayes methods, sec. 6.2); given that, the
/// point's errors have a t distribution with d0 + r degrees of freedom, whose covariance is the cofactor
/// times
///
///     (d0 s0^2 + r s^2) / (d0 + r - 2).
struct VariancePrior {
  double freedom = 4;  ///< d0
  double scale = 1;    ///< s0^2

  /// Computes the a-posteriori variance factor of a landmark.
  [[nodiscard]] double factor(double squared_error_sum, double redundancy) const {
    return (freedom * scale + squared_error_sum) / (freedom + redundancy - 2);
  }
};

/// Estimates the prior from the landmarks seen so far.
class VarianceModel {
 public:
  /// Adds a landmark. Throws PreconditionError if `redundancy` is below 1.
  void add(double squared_error_sum, double redundancy);
  /// Returns the prior of the landmarks added; the default prior until there are 100.
  [[nodiscard]] VariancePrior prior() const;

  /// Holds the state of the model, to be stored.
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

/// Computes the derivative of log Gamma at x, which is above 0.
[[nodiscard]] double digamma(double x);
/// Computes the second derivative of log Gamma at x, which is above 0.
[[nodiscard]] double trigamma(double x);
/// Computes the x with trigamma(x) = `value`, which is above 0.
[[nodiscard]] double inverse_trigamma(double value);

}  // namespace cairn
