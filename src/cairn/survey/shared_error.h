// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace cairn {

/// Estimates what the observations of one landmark have in common: the centre of a feature wanders with the
/// view, and the poses of neighbouring frames err alike. With the share r of the variance common to all n
/// observations, the point's covariance is 1 + r n times that of independent ones. It shows without truth:
/// the points by the first and the second half of a landmark's observations differ by 1 + r n / 2 times what
/// noise explains, as far as halves do not have it in common themselves.
class SharedErrorModel {
 public:
  /// Adds a landmark of `observations` observations, whose halves differ by `difference`: d^T C^-1 d / 3 with
  /// the difference d and its covariance C by noise alone. Ignores a difference that is not above 0.
  void add(double difference, int observations);
  /// Returns r, from the mean logarithm of the differences, which outliers hardly move; 0 until there are
  /// 100.
  [[nodiscard]] double share() const;
  /// Computes by how much the covariance of a landmark exceeds that of independent observations.
  [[nodiscard]] double factor(int observations) const { return 1 + share() * observations; }

  /// Holds the state of the model, to be stored.
  struct Sums {
    std::int64_t count = 0;
    double log = 0;           ///< of the differences
    double observations = 0;  ///< of the landmarks
  };
  SharedErrorModel() = default;
  explicit SharedErrorModel(const Sums& sums) : sums_(sums) {}
  [[nodiscard]] const Sums& sums() const { return sums_; }

 private:
  Sums sums_;
};

}  // namespace cairn
