// SPDX-License-Identifier: Apache-2.0
#include "cairn/calibrate/pose_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "cairn/core/median.h"
#include "cairn/geometry/covariance.h"
#include "cairn/geometry/robust_kernel.h"

namespace cairn {
namespace {

using Matrix8d = Eigen::Matrix<double, 8, 8>;
using Jacobian = Eigen::Matrix<double, 6, 8>;

/// Holds one stretch's residuals and their derivatives by the terms.
struct Equation {
  Vector6d residual;
  Jacobian jacobian;
  std::int64_t first_ns, last_ns;
};

PoseTerms prior_sigma(bool with_time) {
  constexpr double kAngle = 2 * std::numbers::pi / 180, kArm = 0.5, kShare = 0.05, kSeconds = 0.1;
  constexpr double kHeld = 1e-9;
  return (PoseTerms() << kAngle, kAngle, kAngle, kArm, kArm, kArm, kShare, with_time ? kSeconds : kHeld)
      .finished();
}

/// Computes the residuals of a stretch. Returns nullopt if an end has no pose.
std::optional<Vector6d> residual_of(const PoseFitProblem& problem, const Stretch& stretch,
                                    const PoseTerms& terms) {
  const double offset = problem.with_time ? terms[time_term] : 0;
  const auto first = problem.path.at(stretch.first_ns, offset),
             last = problem.path.at(stretch.last_ns, offset);
  if (!first || !last) return std::nullopt;
  const Rigid3& stated = problem.subject_from_camera;
  const Rigid3 camera{rotation_exp(terms.segment<3>(boresight_term)) * stated.rotation,
                      stated.translation + terms.segment<3>(lever_arm_term)};
  const Rigid3 by_poses = camera.inverse() * (first->inverse() * *last) * camera;
  const Rigid3& seen = stretch.first_from_last;
  Vector6d residual;
  residual.head<3>() = rotation_log(seen.rotation.conjugate() * by_poses.rotation);
  residual.tail<3>() = by_poses.translation - (1 + terms[scale_term]) * seen.translation;
  return residual;
}

/// Returns a stretch's equation, by central differences; over 0.06 s by the time, as poses are noisy.
std::optional<Equation> equation_of(const PoseFitProblem& problem, const Stretch& stretch,
                                    const PoseTerms& terms) {
  const PoseTerms step = (PoseTerms() << 1e-5, 1e-5, 1e-5, 1e-4, 1e-4, 1e-4, 1e-5, 0.03).finished();
  const auto residual = residual_of(problem, stretch, terms);
  if (!residual) return std::nullopt;
  Equation equation{*residual, Jacobian::Zero(), stretch.first_ns, stretch.last_ns};
  for (Eigen::Index i = 0; i < terms.size(); ++i) {
    if (i == time_term && !problem.with_time) continue;
    PoseTerms more = terms, less = terms;
    more[i] += step[i];
    less[i] -= step[i];
    const auto above = residual_of(problem, stretch, more), below = residual_of(problem, stretch, less);
    if (!above || !below) return std::nullopt;
    equation.jacobian.col(i) = (*above - *below) / (2 * step[i]);
  }
  return equation;
}

std::vector<Equation> equations_of(const PoseFitProblem& problem, const PoseTerms& terms) {
  std::vector<Equation> equations;
  for (const Stretch& stretch : problem.stretches)
    if (const auto equation = equation_of(problem, stretch, terms)) equations.push_back(*equation);
  return equations;
}

/// Measures the robust standard deviations of the residuals about 0; `degrees` is the share of the residuals
/// that the terms did not adapt to.
Vector6d scatter_of(const std::vector<Equation>& equations, double degrees) {
  constexpr double kLeastAngle = 1e-6, kLeast = 1e-5;  // radians, metres
  Vector6d scatter;
  for (Eigen::Index k = 0; k < 6; ++k) {
    std::vector<double> sizes;
    for (const Equation& equation : equations) sizes.push_back(std::abs(equation.residual[k]));
    scatter[k] = std::max(kSigmaPerMedian * median(std::move(sizes)) / std::sqrt(degrees),
                          k < 3 ? kLeastAngle : kLeast);
  }
  return scatter;
}

/// Returns Huber's weight of a residual over its variance.
double weight_of(double residual, double sigma) {
  constexpr double kHuber = 2;  // standard deviations
  const double r = residual / sigma;
  return kernel_weight(RobustKernel::huber, kHuber, r * r) / (sigma * sigma);
}

/// Accumulates the normal equations of Huber's weights.
void add_equations(const std::vector<Equation>& equations, const Vector6d& scatter, Matrix8d& normal,
                   PoseTerms& right) {
  for (const Equation& equation : equations) {
    for (Eigen::Index k = 0; k < 6; ++k) {
      const double weight = weight_of(equation.residual[k], scatter[k]);
      const PoseTerms row = equation.jacobian.row(k).transpose();
      normal += weight * row * row.transpose();
      right -= weight * equation.residual[k] * row;
    }
  }
}

/// Returns the correlation between residuals `first` to `first` + 2 of stretches and those of the next ones,
/// which begin where they end: an error of the pose between them has the other sign in the next one.
double correlation_of_neighbours(const std::vector<Equation>& equations, const Vector6d& scatter,
                                 Eigen::Index first) {
  constexpr double kLargest = 3;  // standard deviations: outliers say nothing of the others
  constexpr double kMost = 0.45;  // a chain of 0.5 has no information about its ends
  double products = 0, squares = 1e-9;
  for (std::size_t i = 1; i < equations.size(); ++i) {
    if (equations[i - 1].last_ns != equations[i].first_ns) continue;
    for (Eigen::Index k = first; k < first + 3; ++k) {
      const double a = std::clamp(equations[i - 1].residual[k] / scatter[k], -kLargest, kLargest),
                   b = std::clamp(equations[i].residual[k] / scatter[k], -kLargest, kLargest);
      products += a * b;
      squares += (a * a + b * b) / 2;
    }
  }
  return std::clamp(products / squares, -kMost, kMost);
}

/// Returns the covariance of the terms whose residuals correlate between neighbours, `simple` being that of
/// independent ones: H^-1 (H + C) H^-1 with the products C of neighbours (White's sandwich, modelled).
Matrix8d with_correlation(const std::vector<Equation>& equations, const Vector6d& scatter,
                          const Matrix8d& simple) {
  const double of_rotation = correlation_of_neighbours(equations, scatter, 0),
               of_translation = correlation_of_neighbours(equations, scatter, 3);
  Matrix8d products = Matrix8d::Zero();
  for (std::size_t i = 1; i < equations.size(); ++i) {
    const Equation &a = equations[i - 1], &b = equations[i];
    if (a.last_ns != b.first_ns) continue;
    for (Eigen::Index k = 0; k < 6; ++k) {
      const double weight =
          std::sqrt(weight_of(a.residual[k], scatter[k]) * weight_of(b.residual[k], scatter[k]));
      const Matrix8d product = a.jacobian.row(k).transpose() * b.jacobian.row(k);
      products += weight * (k < 3 ? of_rotation : of_translation) * (product + product.transpose());
    }
  }
  const Matrix8d covariance = as_covariance(Matrix8d(simple + simple * products * simple));
  const PoseTerms least = simple.diagonal() / 9;  // never less than a third of the standard deviation
  const PoseTerms factor = covariance.diagonal().cwiseMax(least).cwiseQuotient(simple.diagonal()).cwiseSqrt();
  return factor.asDiagonal() * simple * factor.asDiagonal();
}

/// Returns the share of the residuals that is left after the terms took theirs.
double free_share(const Matrix8d& covariance, const PoseTerms& prior_information, std::size_t equations) {
  const double of_terms = 8 - covariance.diagonal().dot(prior_information);
  const double all = 6 * static_cast<double>(equations);
  return std::max(1 - of_terms / all, 0.1);
}

}  // namespace

PoseFit fit_poses(const PoseFitProblem& problem) {
  constexpr int kRounds = 30;
  constexpr double kEnd = 1e-3;  // standard deviations
  const PoseTerms information = prior_sigma(problem.with_time).array().square().inverse();
  PoseFit fit;
  fit.covariance = PoseTerms(information.cwiseInverse()).asDiagonal();
  double degrees = 1;
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<Equation> equations = equations_of(problem, fit.value);
    fit.stretches = static_cast<int>(equations.size());
    if (equations.empty()) break;
    fit.scatter = problem.scatter ? *problem.scatter : scatter_of(equations, degrees);
    Matrix8d normal = information.asDiagonal();
    PoseTerms right = -information.cwiseProduct(fit.value);
    add_equations(equations, fit.scatter, normal, right);
    const Eigen::LDLT<Matrix8d> solver(normal);
    fit.covariance = as_covariance(Matrix8d(solver.solve(Matrix8d::Identity())));
    degrees = free_share(fit.covariance, information, equations.size());
    const PoseTerms step = solver.solve(right);
    fit.value += step;
    const PoseTerms sigma = fit.covariance.diagonal().cwiseSqrt();
    if (round < kRounds - 1 && (round < 3 || step.cwiseAbs().cwiseQuotient(sigma).maxCoeff() > kEnd))
      continue;
    fit.covariance = with_correlation(equations, fit.scatter, fit.covariance);
    break;
  }
  return fit;
}

}  // namespace cairn
