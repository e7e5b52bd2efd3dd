// SPDX-License-Identifier: Apache-2.0
#include "cairn/calibrate/pose_calibration.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "cairn/calibrate/stretches.h"
#include "cairn/core/median.h"

namespace cairn {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// Holds what is large for a term, in its unit.
struct Limits {
  double sigma;  ///< largest standard deviation of a term that is determined
  double least;  ///< largest term that does not matter
};

Limits limits_of(Eigen::Index term) {
  if (term < lever_arm_term) return {0.05 * kDegree, 0.01 * kDegree};
  if (term < scale_term) return {0.05, 0.01};
  return term == scale_term ? Limits{0.003, 0.001} : Limits{0.005, 0.001};
}

/// Returns a term with its unit, in which people think of it.
std::string describe(Eigen::Index term, double value) {
  if (term < lever_arm_term) return fmt::format("{:.3f} deg", value / kDegree);
  if (term < scale_term) return fmt::format("{:.3f} m", value);
  return term == scale_term ? fmt::format("{:.2f} %", 100 * value) : fmt::format("{:.4f} s", value);
}

void mark_all_undetermined(const std::string& why, PoseCalibration& found) {
  found.findings.fill(Finding::undetermined);
  found.why.fill(why);
}

void fill_figures(const std::vector<Stretch>& stretches, PoseCalibration& found) {
  std::vector<double> seconds;
  for (const Stretch& stretch : stretches) {
    found.turn_deg += rotation_angle(stretch.first_from_last.rotation) / kDegree;
    found.path_m += stretch.first_from_last.translation.norm();
    seconds.push_back(1e-9 * static_cast<double>(stretch.last_ns - stretch.first_ns));
  }
  if (!seconds.empty()) found.stretch_s = median(std::move(seconds));
}

/// Returns whether poses a little earlier and later are known at the ends of most stretches.
bool can_be_shifted(const std::vector<Stretch>& stretches, const PosePath& path) {
  constexpr double kShift = 0.03;  // seconds, as fit_poses does
  const auto is_known = [&](const Stretch& stretch) {
    return path.at(stretch.first_ns, kShift) && path.at(stretch.first_ns, -kShift) &&
           path.at(stretch.last_ns, kShift) && path.at(stretch.last_ns, -kShift);
  };
  const auto known = std::count_if(stretches.begin(), stretches.end(), is_known);
  return 2 * known > static_cast<std::ptrdiff_t>(stretches.size());
}

/// Enlarges the standard deviations as the fits of both halves of the stretches show: all of them if the fits
/// differ by more than their covariances allow, as then the model lacks something; and each to half of what
/// both differ by, where each half determines a term about as well as it should be, or they contradict each
/// other.
void compare_halves(PoseFitProblem problem, const PoseFit& whole, PoseTerms& sigma) {
  constexpr double kContradiction = 2.5;  // standard deviations
  const std::span<const Stretch> all = problem.stretches;
  problem.scatter = whole.scatter;
  problem.stretches = all.first(all.size() / 2);
  const PoseFit first = fit_poses(problem);
  problem.stretches = all.subspan(all.size() / 2);
  const PoseFit second = fit_poses(problem);
  const PoseTerms difference = first.value - second.value;
  const Eigen::Matrix<double, 8, 8> expected = first.covariance + second.covariance;
  const double factor = difference.dot(expected.ldlt().solve(difference)) / 8;  // 1 on average
  sigma *= std::sqrt(std::max(1.0, factor));
  for (Eigen::Index i = 0; i < sigma.size(); ++i) {
    const double largest = std::sqrt(std::max(first.covariance(i, i), second.covariance(i, i)));
    const double size = std::abs(difference[i]);
    if (largest < 2 * limits_of(i).sigma || size > kContradiction * std::sqrt(expected(i, i)))
      sigma[i] = std::max(sigma[i], size / 2);
  }
}

/// Says why a term is undetermined; `by_scatter` is its standard deviation without a look at both halves.
std::string why_undetermined(Eigen::Index term, const PoseCalibration& found, double by_scatter) {
  const std::string known =
      fmt::format("known to {} only, and {} is needed", describe(term, found.sigma[term]),
                  describe(term, limits_of(term).sigma));
  if (by_scatter <= limits_of(term).sigma)
    return term == scale_term
               ? known + ": both halves of the recording differ, or disparities are not well known"
               : known + ": both halves of the recording differ";
  if (term == scale_term) return fmt::format("{}: the camera moves by {:.1f} m in all", known, found.path_m);
  if (term == time_term) return known + ": speed and turning change too little";
  return fmt::format("{}: the camera turns too little about the other axes ({:.0f} deg in all)", known,
                     found.turn_deg);
}

void judge(const PoseTerms& by_scatter, PoseCalibration& found) {
  constexpr double kSigmas = 3;
  for (Eigen::Index i = 0; i < found.value.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Limits limits = limits_of(i);
    const double size = std::abs(found.value[i]);
    if (found.sigma[i] > limits.sigma) {
      found.findings[k] = Finding::undetermined;
      found.why[k] = why_undetermined(i, found, by_scatter[i]);
    } else {
      found.findings[k] =
          size > kSigmas * found.sigma[i] && size > limits.least ? Finding::off : Finding::as_stated;
    }
  }
}

/// Returns whether the poses disagree with the images whatever the terms are.
bool disagrees(const PoseFit& fit, const PoseCalibration& found) {
  constexpr double kLargestAngle = 3 * kDegree, kLargestShare = 0.3;
  const double length = found.path_m / std::max(fit.stretches, 1);
  return fit.scatter.head<3>().maxCoeff() > kLargestAngle ||
         fit.scatter.tail<3>().maxCoeff() > std::max(kLargestShare * length, 0.05);
}

}  // namespace

Rigid3 PoseCalibration::corrected(const Rigid3& subject_from_camera) const {
  Eigen::Vector3d turn = Eigen::Vector3d::Zero(), arm = Eigen::Vector3d::Zero();
  for (int i = 0; i < 3; ++i) {
    if (is_off(boresight_term + i)) turn[i] = value[boresight_term + i];
    if (is_off(lever_arm_term + i)) arm[i] = value[lever_arm_term + i];
  }
  return {(rotation_exp(turn) * subject_from_camera.rotation).normalized(),
          subject_from_camera.translation + arm};
}

PoseCalibration calibrate_poses(const Trajectory& visual, const GivenPath& given,
                                const PoseCalibrationOptions& options) {
  constexpr int kFewestStretches = 6;
  constexpr double kUnknownSeconds = 0.1;  // the prior of a time offset that is not sought
  PoseCalibration found;
  const std::vector<Stretch> stretches = cut_stretches(visual);
  fill_figures(stretches, found);
  PoseFitProblem problem{stretches, given.path, given.subject_from_camera};
  problem.with_time = options.has_times && can_be_shifted(stretches, given.path);
  const PoseFit fit = fit_poses(problem);
  found.stretches = fit.stretches;
  found.scatter = fit.scatter;
  found.value = fit.value;
  found.sigma = fit.covariance.diagonal().cwiseSqrt();
  if (!problem.with_time) found.sigma[time_term] = kUnknownSeconds;
  if (fit.stretches < kFewestStretches) {
    mark_all_undetermined(fmt::format("the camera moves, with poses, in {} stretches of the recording only; "
                                      "{} are needed",
                                      fit.stretches, kFewestStretches),
                          found);
    return found;
  }
  if (disagrees(fit, found)) {
    mark_all_undetermined("poses and images show different motions ('cairn map' names known misreadings)",
                          found);
    return found;
  }
  const PoseTerms by_scatter = found.sigma;
  compare_halves(problem, fit, found.sigma);
  found.sigma[scale_term] = std::hypot(found.sigma[scale_term], options.scale_sigma);
  judge(by_scatter, found);
  if (!problem.with_time)
    found.why[time_term] = options.has_times ? "the poses are too far apart in time to be interpolated"
                                             : "the recording has no times";
  if (!problem.with_time) found.findings[time_term] = Finding::undetermined;
  return found;
}

std::vector<Quantity> quantities_of(const PoseCalibration& found, const std::string& scale_name) {
  std::vector<Quantity> quantities;
  const auto add = [&](const std::string& name, const std::string& unit, int term, double factor) {
    const auto k = static_cast<std::size_t>(term);
    quantities.push_back({name, unit, factor * found.value[term], factor * found.sigma[term],
                          found.findings[k], found.why[k], false});
  };
  add(scale_name, "", scale_term, 1);
  quantities.back().value = found.scale_factor();
  add("time offset", "s", time_term, 1);
  for (int i = 0; i < 3; ++i)
    add(fmt::format("boresight {}", "xyz"[i]), "deg", boresight_term + i, 1 / kDegree);
  for (int i = 0; i < 3; ++i) add(fmt::format("lever arm {}", "xyz"[i]), "m", lever_arm_term + i, 1);
  return quantities;
}

}  // namespace cairn
