// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>

namespace cairn {

/// Tests stated covariances against known errors. For landmarks an error is 3 metres, for poses
/// left_perturbation(estimate, truth), 6 numbers; any error with a covariance in the same coordinates can be
/// used.

/// Computes the normalised estimation error squared, NEES: error^T covariance^-1 error (Bar-Shalom, Li and
/// Kirubarajan 2001, "Estimation with applications to tracking and navigation", sec. 5.4). If the covariance
/// is honest and the error Gaussian, it is chi-square distributed with error.size() degrees of freedom.
/// Returns nullopt if a number is not finite, or the covariance is not symmetric and positive definite (a
/// correlation within 1e-13 of +-1 is not): then it states no uncertainty. `covariance` is square, as large
/// as `error`.
[[nodiscard]] std::optional<double> normalized_error_squared(
    const Eigen::Ref<const Eigen::VectorXd>& error, const Eigen::Ref<const Eigen::MatrixXd>& covariance);

/// Holds the observed share of errors inside the confidence ellipsoid of the nominal share.
struct Coverage {
  double nominal = 0;         ///< share, 0 to 1
  std::size_t inside = 0;     ///< number of errors inside
  double actual = 0;          ///< observed share, 0 to 1
  double standard_error = 0;  ///< of `actual`, if the covariances are honest and the errors independent
};

/// Names the result of the test of the mean NEES.
enum class CovarianceVerdict {
  honest,         ///< the mean NEES lies within its interval
  overconfident,  ///< the mean NEES is above its interval: the errors are larger than stated
  pessimistic     ///< the mean NEES is below its interval: the errors are smaller than stated
};

/// Holds the result of assess_consistency.
struct ConsistencyReport {
  std::size_t count = 0;
  int degrees_of_freedom = 0;
  /// Near degrees_of_freedom if honest; the root of their ratio is the factor of the standard deviations.
  double mean_nees = 0;
  /// Interval in which the mean lies with 95 % probability if the covariances are honest and the errors
  /// independent (Bar-Shalom et al., sec. 5.4). Correlated errors, as of successive poses, spread wider.
  double mean_nees_low = 0, mean_nees_high = 0;
  CovarianceVerdict verdict = CovarianceVerdict::honest;
  Coverage coverage68, coverage95;  ///< nominal 0.68 and 0.95
};

/// Assesses the NEES of many errors, each finite, >= 0 and of `degrees_of_freedom` (>= 1). Returns nullopt
/// for no errors; throws PreconditionError if a value is out of range.
[[nodiscard]] std::optional<ConsistencyReport> assess_consistency(std::span<const double> nees,
                                                                  int degrees_of_freedom);

}  // namespace cairn
