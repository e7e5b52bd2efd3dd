// SPDX-License-Identifier: Apache-2.0
#include "cairn/calibrate/calibrate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "cairn/calibrate/depth_shift.h"
#include "cairn/calibrate/pair_calibration.h"

namespace cairn {
namespace {

void set_baseline(double factor, Calibration& calibration) {
  if (calibration.raw_stereo) {
    StereoPair pair = calibration.raw_stereo->pair;
    pair.left_from_right.translation *= factor;
    set_raw_stereo(pair, {}, calibration);
  } else if (calibration.baseline) {
    *calibration.baseline *= factor;
  }
  if (calibration.depth) calibration.depth->scale /= factor;
}

/// Sets where the camera sits on the body; of a raw pair that is the left camera as it was recorded.
void set_body(const Rigid3& body_from_loaded, Calibration& calibration) {
  const Rigid3 recorded_from_loaded = body_from_loaded_camera(calibration, Rigid3{});
  calibration.body_from_camera = body_from_loaded * recorded_from_loaded.inverse();
}

/// Applies what is off to the calibration and marks it as written.
void apply_pose_terms(const GivenPath& given, bool apply_baseline, CalibrationResult& result,
                      std::vector<Quantity>& quantities) {
  const PoseCalibration& found = *result.poses;
  constexpr std::ptrdiff_t kBoresight = 2;  // after the factor and the time offset
  const auto is_off = [](const Quantity& quantity) { return quantity.finding == Finding::off; };
  if (given.is_of_body && std::any_of(quantities.begin() + kBoresight, quantities.end(), is_off)) {
    set_body(found.corrected(given.subject_from_camera), result.calibration);
    for (auto i = quantities.begin() + kBoresight; i != quantities.end(); ++i) i->is_written = is_off(*i);
  }
  if (!apply_baseline || !found.is_off(scale_term)) return;
  set_baseline(found.scale_factor(), result.calibration);
  quantities[0].is_written = true;
}

void compare_with_poses(const Trajectory& visual, const GivenPath& given,
                        const PoseCalibrationOptions& pose_options, bool apply_baseline,
                        CalibrationResult& result) {
  result.poses = calibrate_poses(visual, given, pose_options);
  const bool is_pair = result.calibration.baseline.has_value();
  auto quantities = quantities_of(*result.poses, is_pair ? "baseline factor" : "depth factor");
  apply_pose_terms(given, apply_baseline, result, quantities);
  result.quantities.insert(result.quantities.end(), quantities.begin(), quantities.end());
}

/// Moves the depth images and runs again until no shift is left, at most four times. Returns the quantities
/// of the shift.
std::vector<Quantity> settle_depth(SettledRun& run, const SlamOptions& options, const Executor& executor,
                                   Progress& progress) {
  constexpr int kMostRuns = 4;
  DepthShift left = measure_depth_shift(run.sequence, run.slam, executor);
  const auto is_off = [&](std::size_t k) { return left.findings[k] == Finding::off; };
  std::array<bool, 2> was_off{};
  Eigen::Vector2d moved = Eigen::Vector2d::Zero();
  const auto is_left = [&](std::size_t k) {  // of a shift that is corrected, all that is seen of it
    const auto at = static_cast<Eigen::Index>(k);
    return is_off(k) || (was_off[k] && std::abs(left.value[at]) > left.sigma[at]);
  };
  for (int i = 1; i < kMostRuns && (is_left(0) || is_left(1)) && !run.slam.stopped; ++i) {
    Eigen::Vector2d step = Eigen::Vector2d::Zero();
    for (std::size_t k = 0; k < 2; ++k) {
      was_off[k] = was_off[k] || is_off(k);
      if (was_off[k]) step[static_cast<Eigen::Index>(k)] = left.value[static_cast<Eigen::Index>(k)];
    }
    moved += step;
    move_depth(step, run.sequence.calibration);
    run = run_until_settled(run.sequence, options, executor, progress);
    left = measure_depth_shift(run.sequence, run.slam, executor);
  }
  std::vector<Quantity> quantities = quantities_of(left);
  for (std::size_t k = 0; k < 2; ++k) {
    if (!was_off[k]) continue;
    quantities[k].value = moved[static_cast<Eigen::Index>(k)];  // what is left is not significant
    quantities[k].finding = Finding::off;
    quantities[k].why.clear();
    quantities[k].is_written = true;
  }
  return quantities;
}

}  // namespace

bool CalibrationResult::has_answer() const {
  return std::any_of(quantities.begin(), quantities.end(),
                     [](const Quantity& quantity) { return quantity.finding != Finding::undetermined; });
}

CalibrationResult calibrate(const Sequence& recorded, const std::optional<GivenPath>& given,
                            const CalibrateOptions& options, const Executor& executor, Progress& progress) {
  CalibrationResult result;
  SettledRun run = run_until_settled(recorded, options.slam, executor, progress);
  result.quantities = quantities_of(run);
  if (recorded.calibration.depth && !run.slam.map.keyframes().empty())
    result.quantities = settle_depth(run, options.slam, executor, progress);
  result.rows = run.rows;
  result.rows_applied = run.rows_applied;
  result.disparities = run.disparities;
  result.calibration = run.sequence.calibration;
  result.frames = run.slam.frames.size();
  result.tracked = run.slam.trajectory().size();
  result.unreadable = run.slam.unreadable.size();
  result.stopped = run.slam.stopped;
  if (!given || run.slam.stopped) return result;
  const PoseCalibrationOptions pose_options{scale_sigma_by_disparities(run), recorded.has_times};
  compare_with_poses(motions_for_scale(run, executor, progress), *given, pose_options, options.apply_baseline,
                     result);
  return result;
}

}  // namespace cairn
