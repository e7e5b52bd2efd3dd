// SPDX-License-Identifier: Apache-2.0
#include "cairn/evaluate/consistency.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "cairn/core/error.h"
#include "cairn/evaluate/chi_square.h"

namespace cairn {
namespace {

bool is_symmetric(const Eigen::MatrixXd& correlation) {
  constexpr double kRounding = 1e-9;  // of a correlation, as left by a file's digits
  return ((correlation - correlation.transpose()).array().abs() <= kRounding).all();
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
  // in units of the sigmas, so that the test for rank does not depend on units of metres or radians
  const Eigen::VectorXd variances = covariance.diagonal();
  if (!error.allFinite() || !covariance.allFinite() || !(variances.array() > 0).all()) return std::nullopt;
  const Eigen::VectorXd per_sigma = variances.cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd correlation = per_sigma.asDiagonal() * covariance * per_sigma.asDiagonal();
  if (!is_symmetric(correlation)) return std::nullopt;
  const Eigen::LLT<Eigen::MatrixXd> factor(correlation);
  constexpr double kRounding = 1e-13;
  const Eigen::MatrixXd root = factor.matrixL();
  if (factor.info() != Eigen::Success || !(root.diagonal().array().square() > kRounding).all())
    return std::nullopt;
  const Eigen::VectorXd normalized = factor.matrixL().solve(per_sigma.cwiseProduct(error));
  return normalized.squaredNorm();
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
  report.coverage68 = count_inside(nees, 0.68, degrees_of_freedom);
  report.coverage95 = count_inside(nees, 0.95, degrees_of_freedom);
  return report;
}

}  // namespace cairn
