// SPDX-License-Identifier: Apache-2.0
#include "cairn/evaluate/consistency.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "cairn/core/error.h"
#include "cairn/core/median.h"
#include "cairn/evaluate/chi_square.h"

namespace cairn {
namespace {

bool is_symmetric(const Eigen::MatrixXd& correlation) {
  constexpr double kRounding = 1e-9;  // of a correlation, as left by a file's digits
  return ((correlation - correlation.transpose()).array().abs() <= kRounding).all();
}

/// Computes the Cholesky factor of the correlations, that is, in units of the standard deviations, so that
/// the test for rank does not depend on units of metres or radians. Returns nullopt if the matrix is no
/// covariance of full rank.
std::optional<Eigen::MatrixXd> root_of(const Eigen::Ref<const Eigen::MatrixXd>& covariance) {
  constexpr double kRounding = 1e-13;
  const Eigen::VectorXd variances = covariance.diagonal();
  if (!covariance.allFinite() || !(variances.array() > 0).all()) return std::nullopt;
  const Eigen::VectorXd per_sigma = variances.cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd correlation = per_sigma.asDiagonal() * covariance * per_sigma.asDiagonal();
  if (!is_symmetric(correlation)) return std::nullopt;
  const Eigen::LLT<Eigen::MatrixXd> factor(correlation);
  Eigen::MatrixXd root = factor.matrixL();
  const bool is_full =
      factor.info() == Eigen::Success && (root.diagonal().array().square() > kRounding).all();
  return is_full ? std::optional(std::move(root)) : std::nullopt;
}

Coverage count_inside(std::span<const double> nees, double nominal, int degrees_of_freedom) {
  const double bound = chi_square_quantile(nominal, degrees_of_freedom);
  const auto count = static_cast<double>(nees.size());
  Coverage coverage{nominal, 0, 0, std::sqrt(nominal * (1 - nominal) / count)};
  coverage.inside = static_cast<std::size_t>(
      std::count_if(nees.begin(), nees.end(), [&](double value) { return value <= bound; }));
  coverage.actual = static_cast<double>(coverage.inside) / count;
  return coverage;
}

/// Computes the observed shares at the nominal shares 0, 0.01, ..., 1.
std::vector<double> shares_inside(std::span<const double> nees, int degrees_of_freedom) {
  constexpr int kSteps = 100;
  std::vector<double> sorted(nees.begin(), nees.end());
  std::sort(sorted.begin(), sorted.end());
  std::vector<double> shares;
  for (int i = 0; i < kSteps; ++i) {
    const double bound =
        i == 0 ? 0 : chi_square_quantile(static_cast<double>(i) / kSteps, degrees_of_freedom);
    const auto inside = std::upper_bound(sorted.begin(), sorted.end(), bound) - sorted.begin();
    shares.push_back(static_cast<double>(inside) / static_cast<double>(sorted.size()));
  }
  shares.push_back(1);
  return shares;
}

CovarianceVerdict judge(const ConsistencyReport& report) {
  if (report.mean_nees > report.mean_nees_high) return CovarianceVerdict::overconfident;
  if (report.mean_nees < report.mean_nees_low) return CovarianceVerdict::pessimistic;
  return CovarianceVerdict::honest;
}

}  // namespace

std::optional<double> normalized_error_squared(const Eigen::Ref<const Eigen::VectorXd>& error,
                                               const Eigen::Ref<const Eigen::MatrixXd>& covariance) {
  require(error.size() >= 1, "an error has at least one coordinate");
  require(covariance.rows() == error.size() && covariance.cols() == error.size(),
          "a covariance is square, as large as its error");
  if (!error.allFinite()) return std::nullopt;
  const auto root = root_of(covariance);
  if (!root) return std::nullopt;
  const Eigen::VectorXd per_sigma = error.cwiseQuotient(covariance.diagonal().cwiseSqrt());
  return root->triangularView<Eigen::Lower>().solve(per_sigma).squaredNorm();
}

bool is_positive_definite(const Eigen::Ref<const Eigen::MatrixXd>& matrix) {
  require(matrix.rows() == matrix.cols(), "a covariance is square");
  return root_of(matrix).has_value();
}

std::optional<ConsistencyReport> assess_consistency(std::span<const double> nees, int degrees_of_freedom) {
  require(degrees_of_freedom >= 1, "degrees of freedom are at least 1");
  require(
      std::all_of(nees.begin(), nees.end(), [](double value) { return value >= 0 && std::isfinite(value); }),
      "a NEES is finite and not below 0");
  if (nees.empty()) return std::nullopt;
  const auto count = static_cast<double>(nees.size());
  const double sum_degrees = count * degrees_of_freedom;  // the sum of chi-squares is one, too
  ConsistencyReport report;
  report.count = nees.size();
  report.degrees_of_freedom = degrees_of_freedom;
  report.mean_nees = std::accumulate(nees.begin(), nees.end(), 0.0) / count;
  report.mean_nees_low = chi_square_quantile(0.025, sum_degrees) / count;
  report.mean_nees_high = chi_square_quantile(0.975, sum_degrees) / count;
  report.verdict = judge(report);
  report.median_nees = median(std::vector<double>(nees.begin(), nees.end()));
  report.expected_median = chi_square_quantile(0.5, degrees_of_freedom);
  for (std::size_t i = 0; i < kNominalShares.size(); ++i)
    report.coverage[i] = count_inside(nees, kNominalShares[i], degrees_of_freedom);
  report.curve = shares_inside(nees, degrees_of_freedom);
  return report;
}

void ErrorCollector::add(const Eigen::Ref<const Eigen::VectorXd>& error,
                         const Eigen::Ref<const Eigen::MatrixXd>& covariance) {
  const auto size = static_cast<int>(error.size());
  require(nees_.empty() || size == degrees_of_freedom_, "errors of one kind have as many coordinates");
  const auto squared = normalized_error_squared(error, covariance);
  require(squared.has_value(), "an error is finite and its covariance positive definite");
  degrees_of_freedom_ = size;
  nees_.push_back(*squared);
  stds_.push_back(std::sqrt(covariance.trace()));
  lengths_.push_back(error.norm());
  const double trace = covariance.trace(), trace_of_square = covariance.squaredNorm();
  squared_lengths_.push_back({trace_of_square / trace, std::max(1.0, trace * trace / trace_of_square)});
}

double ErrorCollector::expected_median_length() const {
  constexpr std::size_t kMost = 2000;  // more of them, evenly chosen, would hardly move the median
  const std::size_t step = 1 + (squared_lengths_.size() - 1) / kMost;
  const auto share_below = [&](double length) {
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < squared_lengths_.size(); i += step, ++count)
      sum += chi_square_probability(length * length / squared_lengths_[i].unit,
                                    squared_lengths_[i].degrees_of_freedom);
    return sum / count;
  };
  double low = 0, high = *std::max_element(stds_.begin(), stds_.end());  // above the median of any
  constexpr int kHalvings = 40;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (share_below(middle) < 0.5 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

std::optional<ErrorConsistency> ErrorCollector::assess() const {
  if (nees_.empty()) return std::nullopt;
  return ErrorConsistency{assess_consistency(nees_, degrees_of_freedom_).value(), median(stds_),
                          median(lengths_), expected_median_length()};
}

}  // namespace cairn
