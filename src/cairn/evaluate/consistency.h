// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

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

/// Tells whether a matrix is symmetric and positive definite as normalized_error_squared demands it of a
/// covariance. `matrix` is square.
[[nodiscard]] bool is_positive_definite(const Eigen::Ref<const Eigen::MatrixXd>& matrix);

/// Nominal shares at which the coverage is stated.
inline constexpr std::array<double, 4> kNominalShares = {0.50, 0.68, 0.95, 0.99};

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
  /// Near degrees_of_freedom if honest; the root of their ratio is the factor of the standard deviations. A
  /// few gross errors dominate it.
  double mean_nees = 0;
  /// Interval in which the mean lies with 95 % probability if the covariances are honest and the errors
  /// independent (Bar-Shalom et al., sec. 5.4). Correlated errors, as of successive poses, spread wider.
  double mean_nees_low = 0, mean_nees_high = 0;
  CovarianceVerdict verdict = CovarianceVerdict::honest;
  double median_nees = 0;      ///< of an even number the larger of the two in the middle
  double expected_median = 0;  ///< median of the chi-square distribution, near median_nees if honest
  std::array<Coverage, kNominalShares.size()> coverage;  ///< for each of kNominalShares
  /// Observed shares inside the ellipsoids of the nominal shares 0, 0.01, ..., 1: the cumulative distribution
  /// of the errors' probabilities, a diagonal if honest.
  std::vector<double> curve;

  /// Returns mean_nees per degree of freedom: 1 if honest.
  [[nodiscard]] double mean_per_freedom() const { return mean_nees / degrees_of_freedom; }
  /// Returns median_nees over the median of the chi-square distribution: 1 if honest.
  [[nodiscard]] double median_ratio() const { return median_nees / expected_median; }
};

/// Assesses the NEES of many errors, each finite, >= 0 and of `degrees_of_freedom` (>= 1). Returns nullopt
/// for no errors; throws PreconditionError if a value is out of range.
[[nodiscard]] std::optional<ConsistencyReport> assess_consistency(std::span<const double> nees,
                                                                  int degrees_of_freedom);

/// Holds errors of one kind and what was stated of them.
struct ErrorConsistency {
  ConsistencyReport report;
  /// Median of the stated standard deviations, each the root of the trace of its covariance: the root mean
  /// square length of the error that is stated.
  double median_std = 0;
  double median_error = 0;  ///< median length of the errors
  /// Median length of honest errors of these covariances: the squared length of each is taken for a multiple
  /// of a chi-square variable with the same mean and variance (Satterthwaite 1946).
  double expected_median_error = 0;

  /// Returns median_std over median_error; infinite without errors.
  [[nodiscard]] double std_per_error() const { return median_std / median_error; }
  /// Returns what std_per_error is if the covariances are honest: 1.13 if they are all the same in three
  /// directions, 1.48 in one, more if they differ among each other.
  [[nodiscard]] double honest_std_per_error() const { return median_std / expected_median_error; }
};

/// Collects errors of one kind with their covariances. All have the same number of coordinates.
class ErrorCollector {
 public:
  /// Adds an error. Throws PreconditionError unless it is finite and the covariance is positive definite.
  void add(const Eigen::Ref<const Eigen::VectorXd>& error,
           const Eigen::Ref<const Eigen::MatrixXd>& covariance);
  [[nodiscard]] std::size_t count() const { return nees_.size(); }
  /// Assesses what was added. Returns nullopt for no errors.
  [[nodiscard]] std::optional<ErrorConsistency> assess() const;

 private:
  /// Holds the chi-square variable whose multiple the squared length of an error is taken for.
  struct SquaredLength {
    double unit = 0, degrees_of_freedom = 0;
  };
  [[nodiscard]] double expected_median_length() const;

  int degrees_of_freedom_ = 0;
  std::vector<double> nees_, stds_, lengths_;
  std::vector<SquaredLength> squared_lengths_;
};

}  // namespace cairn
