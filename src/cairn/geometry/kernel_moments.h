// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cairn/geometry/robust_kernel.h"

namespace cairn {

/// Describes the effect of a robust kernel and a limit on correct observations, whose squared error s in
/// variances is chi-square with `degrees_of_freedom`: means over those with s below the limit, w =
/// kernel_weight(s). An estimate that weights by w and leaves out what exceeds the limit has the covariance
/// A^-1 B A^-1, A = sensitivity sum J^T J and B = force sum J^T J (Huber 1981, Robust Statistics, sec. 6.3;
/// valid for the limit too, since the mean of psi' is that of psi times the error, by partial integration).
struct KernelMoments {
  double share = 1;        ///< share of correct observations that are below the limit
  double weight = 1;       ///< mean of w
  double sensitivity = 1;  ///< mean of w s over the degrees of freedom
  double force = 1;        ///< mean of w^2 s over the degrees of freedom
  double squares = 0;      ///< mean of w s
  double slope = 0;        ///< derivative of `squares` by the variance of the errors, at 1

  /// Computes the mean of w s of residuals with the given variance (1 for `squares`), to first order.
  [[nodiscard]] double expected_squares(double variance) const { return squares + slope * (variance - 1); }
};

/// Computes the moments by numerical integration, to a relative error of 1e-3. `degrees_of_freedom` is 2 or
/// 3; `limit` is above 0 and may be infinite. Throws PreconditionError otherwise.
[[nodiscard]] KernelMoments kernel_moments(RobustKernel kernel, double scale, int degrees_of_freedom,
                                           double limit);

}  // namespace cairn
