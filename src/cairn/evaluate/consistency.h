// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>

namespace cairn {

/// Whether stated covariances are honest, where the truth is known. For landmarks an error is 3 metres, for
/// poses left_perturbation(estimate, truth), 6 numbers; anything with a covariance in the same coordinates.

/// Normalised estimation error squared, NEES: error^T covariance^-1 error (Bar-Shalom, Li and Kirubarajan
/// 2001, "Estimation with applications to tracking and navigation", sec. 5.4). If the covariance is honest
/// and the error Gaussian, it is chi-square distributed with error.size() degrees of freedom. Nothing where a
/// number is not finite, or the covariance is not symmetric and positive definite (a correlation within 1e-13
/// of +-1 is not): then it states no uncertainty. `covariance` is square, as large as `error`.
[[nodiscard]] std::optional<double> normalized_error_squared(
    const Eigen::Ref<const Eigen::VectorXd>& error, const Eigen::Ref<const Eigen::MatrixXd>& covariance);

/// How many errors lie in the ellipsoid that is to hold this share of them.
struct Coverage {
  double nominal = 0;  ///< share, 0 to 1
  std::size_t inside = 0;
  double actual = 0;          ///< share
  double standard_error = 0;  ///< of `actual`, were the covariances honest and the errors independent
};

enum class CovarianceVerdict {
  honest,         ///< the mean NEES lies within its interval
  overconfident,  ///< above: the errors are larger than stated
  pessimistic     ///< below: the errors are smaller than stated
};

struct ConsistencyReport {
  std::size_t count = 0;
  int degrees_of_freedom = 0;
  double mean_nees =
      0;  ///< near degrees_of_freedom where honest; the ratio's root is the factor of the sigmas
  /// Where the mean lies with 95 % probability if the covariances are honest and the errors independent
  /// (Bar-Shalom et al., sec. 5.4). Correlated errors, as of successive poses, spread wider.
  double mean_nees_low = 0, mean_nees_high = 0;
  CovarianceVerdict verdict = CovarianceVerdict::honest;
  Coverage coverage68, coverage95;  ///< nominal 0.68 and 0.95
};

/// From the NEES of many errors, each finite, >= 0 and of `degrees_of_freedom` (>= 1); nothing for none.
[[nodiscard]] std::optional<ConsistencyReport> assess_consistency(std::span<const double> nees,
                                                                  int degrees_of_freedom);

}  // namespace cairn
