// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace cairn {

/// Computes the probability that a chi-square variable with `degrees_of_freedom` (1 to 1e9) is at most
/// `value`: the regularised lower incomplete gamma function P(degrees_of_freedom / 2, value / 2). Returns 0
/// for a value below 0. Absolute error below 1e-13 up to 1e3 degrees of freedom, below 1e-12 up to 1e5.
[[nodiscard]] double chi_square_probability(double value, double degrees_of_freedom);

/// Computes the value that a chi-square variable does not exceed with `probability` (0 < probability < 1).
[[nodiscard]] double chi_square_quantile(double probability, double degrees_of_freedom);

}  // namespace cairn
