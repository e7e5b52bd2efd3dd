// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "cairn/report/trajectory_plot.h"
#include "evaluate_output.h"
#include "trajectory_inputs.h"

namespace cairn::app {
namespace {

using Pairs = std::vector<PosePair>;

/// A longer step than this many medians means that poses are missing.
std::int64_t longest_step_ns(const Pairs& pairs) {
  constexpr std::int64_t kMedians = 5;
  std::vector<std::int64_t> steps;
  for (std::size_t i = 1; i < pairs.size(); ++i) steps.push_back(pairs[i].stamp_ns - pairs[i - 1].stamp_ns);
  if (steps.empty()) return 0;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return kMedians * *middle;
}

std::string rmse_text(const TrajectoryEvaluation& result) {
  const ShownUnit shown = unit_for(result.absolute.ate_m->max);
  return fmt::format("{:.2f} {}", shown.factor * result.absolute.ate_m->rmse, shown.name);
}

std::vector<TrajectoryPlot::Pose> poses_of(const TrajectoryEvaluation& result, std::int64_t begin_ns) {
  const std::int64_t longest = longest_step_ns(result.pairs);
  std::vector<TrajectoryPlot::Pose> poses;
  for (std::size_t i = 0; i < result.pairs.size(); ++i) {
    const bool connected = i > 0 && result.pairs[i].stamp_ns - result.pairs[i - 1].stamp_ns <= longest;
    poses.push_back({1e-9 * static_cast<double>(result.pairs[i].stamp_ns - begin_ns),
                     result.pairs[i].estimate.translation, result.errors.translation_m[i],
                     result.errors.rotation_deg[i], connected});
  }
  return poses;
}

/// From the first to the last pair of all estimates.
struct TimeRange {
  std::int64_t first_ns = std::numeric_limits<std::int64_t>::max();
  std::int64_t last_ns = std::numeric_limits<std::int64_t>::min();
};

TimeRange time_range(const std::vector<const Evaluated*>& shown) {
  TimeRange range;
  for (const Evaluated* evaluated : shown) {
    range.first_ns = std::min(range.first_ns, evaluated->result.pairs.front().stamp_ns);
    range.last_ns = std::max(range.last_ns, evaluated->result.pairs.back().stamp_ns);
  }
  return range;
}

void add_titles(const EvaluateArguments& arguments, const std::vector<const Evaluated*>& shown,
                TrajectoryPlot& plot) {
  const std::string reference = short_name(arguments.reference);
  if (shown.size() > 1) {
    plot.title = fmt::format("{} estimates against {}", shown.size(), reference);
    plot.subtitle = fmt::format("aligned by {}; with each its ATE, rmse", arguments.align);
    return;
  }
  const TrajectoryEvaluation& result = shown.front()->result;
  plot.title = fmt::format("ATE {} rmse, {} poses", rmse_text(result), result.pairs.size());
  plot.subtitle = fmt::format("{} against {}, aligned by {}", short_name(shown.front()->path), reference,
                              arguments.align);
}

}  // namespace

std::string draw_evaluations(const Evaluations& evaluations) {
  std::vector<const Evaluated*> shown;
  for (const auto& evaluated : evaluations.estimates)
    if (evaluated.result.status == EvaluationStatus::ok) shown.push_back(&evaluated);
  TrajectoryPlot plot;
  add_titles(evaluations.arguments, shown, plot);
  const TimeRange range = time_range(shown);
  constexpr std::int64_t kMargin = 1'000'000'000;
  for (const auto& pose : evaluations.reference) {
    const bool during = pose.stamp_ns >= range.first_ns - kMargin && pose.stamp_ns <= range.last_ns + kMargin;
    if (during) plot.reference.push_back(pose.world_from_camera.translation);
  }
  for (const Evaluated* evaluated : shown) {
    const std::string name =
        shown.size() == 1 ? "estimate"
                          : fmt::format("{} {}", short_name(evaluated->path), rmse_text(evaluated->result));
    plot.estimates.push_back({name, poses_of(evaluated->result, range.first_ns)});
  }
  return draw_trajectory_plot(plot);
}

}  // namespace cairn::app
