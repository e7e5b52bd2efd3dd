// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace cairn {

/// Names the cost rho(s) of a residual with the square s (in variances); c is the scale.
enum class RobustKernel {
  none,           ///< s
  huber,          ///< s up to c^2, then 2 c sqrt(s) - c^2: outliers pull with constant force
  cauchy,         ///< c^2 log(1 + s / c^2): the force of outliers falls as 1/sqrt(s)
  geman_mcclure,  ///< c^2 s / (c^2 + s): bounded, as dynamic covariance scaling (Agarwal et al. 2013)
};

/// Computes rho(s).
[[nodiscard]] double kernel_cost(RobustKernel kernel, double scale, double s);
/// Computes d rho / d s, the weight of a residual in iteratively reweighted least squares (Zhang 1997,
/// "Parameter estimation techniques", sec. 9.4).
[[nodiscard]] double kernel_weight(RobustKernel kernel, double scale, double s);

}  // namespace cairn
