// SPDX-License-Identifier: Apache-2.0
#include "cairn/calibrate/pair_calibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "cairn/map/map.h"
#include "cairn/slam/window.h"

namespace cairn {
namespace {

constexpr const char* kRowNames[] = {"rows 1", "rows x", "rows y", "rows xy", "rows x2", "rows y2"};
constexpr const char* kFieldNames[] = {"disparity 1", "disparity x", "disparity x2"};

/// Returns whether a field was taken off and still is large enough at the end of the run.
bool is_significant(const DisparityCalibration& found) {
  return found.applied && found.should_be_applied();
}

/// Corrects the rows of the pairs if that matters. The sequence has a correction afterwards in any case, so
/// that run_slam does not measure rows again.
void correct_rows(const Executor& executor, SettledRun& run) {
  run.rows = measure_row_errors(run.sequence, executor);
  run.rows_applied = run.rows.should_be_applied();
  auto& correction = run.sequence.calibration.right_correction;
  if (!correction) correction.emplace();
  if (run.rows_applied) correction->rows += run.rows.field;
}

/// Leaves no correction if there is nothing to correct and none was stated.
void drop_empty_correction(const Sequence& recorded, SettledRun& run) {
  auto& correction = run.sequence.calibration.right_correction;
  const bool is_empty = correction && correction->rows.isZero(0) && correction->disparity.isZero(0);
  if (is_empty && !recorded.calibration.right_correction) correction.reset();
}

/// Computes by what share motions are too long if all disparities are a pixel too small: motion is seen
/// against points with weights of their squared disparities.
double scale_by_disparity(const Map& map) {
  double first = 0, second = 0;
  for (const KeyframeId id : map.keyframe_ids()) {
    for (const Observation& seen : map[id].observed.observations) {
      if (!seen.has_disparity()) continue;
      const double weight = 1 / (seen.sigma_d_px * seen.sigma_d_px);
      first += weight * seen.d;
      second += weight * seen.d * seen.d;
    }
  }
  return second > 0 ? first / second : 0;
}

double field_sigma_px(const SlamResult& slam, const Executor& executor) {
  constexpr double kMatchingBias = 0.02;
  const DisparityCalibration& found = slam.disparity_calibration;
  if (!found.is_determined()) return 0;
  const BundleProblem problem = whole_component(slam.map, slam.main_component()).problem;
  return std::max(
      {found.sigma[0] / kFieldSigmaInflation, halves_difference_px(problem, executor) / 2, kMatchingBias});
}

Quantity kind_of_terms(bool is_determined, bool is_applied, const std::string& why) {
  Quantity kind;
  kind.unit = "px";
  kind.finding = is_applied ? Finding::off : is_determined ? Finding::as_stated : Finding::undetermined;
  if (kind.finding == Finding::undetermined) kind.why = why;
  kind.is_written = is_applied;
  return kind;
}

/// Appends the terms of a polynomial, which are judged together.
template <class Vector>
void add_terms(const char* const* names, const Vector& terms, const Vector& sigma, Quantity kind,
               std::vector<Quantity>& quantities) {
  for (Eigen::Index i = 0; i < terms.size(); ++i) {
    kind.name = names[i];
    kind.value = terms[i];
    kind.sigma = sigma[i];
    quantities.push_back(kind);
  }
}

}  // namespace

SettledRun run_until_settled(const Sequence& recorded, const SlamOptions& options, const Executor& executor,
                             Progress& progress) {
  constexpr int kMostRuns = 4;
  SettledRun run;
  run.sequence = recorded;
  run.options = options;
  run.options.observer.stereo_noise.self_calibration = "auto";
  run.options.odometry = false;
  if (is_stereo(recorded)) correct_rows(executor, run);
  for (int i = 0; i < kMostRuns; ++i) {
    run.slam = run_slam(run.sequence, run.options, executor, progress);
    const DisparityCalibration& found = run.slam.disparity_calibration;
    const bool goes_on = is_significant(found);
    if (i == 0) {
      run.disparities = found;
      run.disparities.applied = goes_on;
    } else if (goes_on) {
      run.disparities.field += found.field;
    }
    if (goes_on) run.sequence.calibration.right_correction->disparity += found.field;
    if (!goes_on || run.slam.stopped) break;
  }
  drop_empty_correction(recorded, run);
  run.field_sigma_px = field_sigma_px(run.slam, executor);
  return run;
}

Trajectory motions_for_scale(const SettledRun& run, const Executor& executor, Progress& progress) {
  constexpr double kFewSigmas = 3;
  const DisparityCalibration& found = run.slam.disparity_calibration;
  const bool is_noise = found.rms_px < kFewSigmas * run.field_sigma_px;
  if (!is_stereo(run.sequence) || found.applied || !found.is_determined() || is_noise)
    return run.slam.trajectory();
  Sequence corrected = run.sequence;
  auto& correction = corrected.calibration.right_correction;
  if (!correction) correction.emplace();
  correction->disparity += found.field;
  SlamOptions options = run.options;
  options.observer.stereo_noise.self_calibration = "off";
  return run_slam(corrected, options, executor, progress).trajectory();
}

double scale_sigma_by_disparities(const SettledRun& run) {
  return is_stereo(run.sequence) ? scale_by_disparity(run.slam.map) * run.field_sigma_px : 0;
}

std::vector<Quantity> quantities_of(const SettledRun& run) {
  constexpr double kRowsPrior = 10, kFieldPrior = 1;  // pixels, of terms that were not measured
  std::vector<Quantity> quantities;
  if (!is_stereo(run.sequence)) return quantities;
  const RowErrors& rows = run.rows;
  const DisparityCalibration& found = run.disparities;
  const RowField row_sigma = rows.pairs > 0 ? rows.sigma : RowField::Constant(kRowsPrior);
  const Eigen::Vector3d field_sigma =
      found.estimates > 0 ? found.sigma : Eigen::Vector3d::Constant(kFieldPrior);
  add_terms(kRowNames, rows.field, row_sigma,
            kind_of_terms(rows.is_determined(), run.rows_applied,
                          fmt::format("{} matches in {} pairs are too few", rows.matches, rows.pairs)),
            quantities);
  add_terms(
      kFieldNames, found.field, field_sigma,
      kind_of_terms(found.is_determined(), found.applied,
                    fmt::format("{} disparities of a camera that moves too little, or of too few frames",
                                found.disparities)),
      quantities);
  return quantities;
}

}  // namespace cairn
