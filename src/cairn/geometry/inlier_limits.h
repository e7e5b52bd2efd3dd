// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace cairn {

/// The 95 % quantiles of chi-square with 1, 2 and 3 degrees of freedom: the squared error of a correct
/// measurement of that many coordinates, in variances, exceeds them with a probability of 0.05 (Abramowitz
/// and Stegun 1964, table 26.8). All tests for inliers use them.
constexpr double kInlierLimit1 = 3.841;  ///< of a distance from a line
constexpr double kInlierLimit2 = 5.991;  ///< of (u, v)
constexpr double kInlierLimit3 = 7.815;  ///< of (u, v, d), and of a point in space

/// The squared error, in variances, above which one coordinate is grossly wrong: three standard deviations,
/// which a correct one exceeds with a probability of 0.003.
constexpr double kGrossLimit1 = 9.0;

/// Square root of kInlierLimit2, in standard deviations: a robust kernel of this scale does not reduce the
/// weight of 95 % of the correct (u, v).
constexpr double kInlierScale2 = 2.448;

}  // namespace cairn
