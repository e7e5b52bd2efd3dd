// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <span>

#include "cairn/core/error.h"
#include "cairn/report/evaluation_report.h"
#include "cairn/report/trajectory_plot.h"
#include "cairn/report/trajectory_words.h"

namespace cairn {
namespace {

using Shown = std::vector<const EvaluatedTrajectory*>;

/// Returns the longest step between poses of which none is missing in between.
std::int64_t longest_step_ns(std::span<const PosePair> pairs) {
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

/// Holds the stamps of the first and the last pair of all estimates.
struct TimeRange {
  std::int64_t first_ns = std::numeric_limits<std::int64_t>::max();
  std::int64_t last_ns = std::numeric_limits<std::int64_t>::min();
};

TimeRange time_range(const Shown& shown) {
  TimeRange range;
  for (const EvaluatedTrajectory* evaluated : shown) {
    range.first_ns = std::min(range.first_ns, evaluated->result.pairs.front().stamp_ns);
    range.last_ns = std::max(range.last_ns, evaluated->result.pairs.back().stamp_ns);
  }
  return range;
}

void add_titles(const EvaluationReport& report, const Shown& shown, TrajectoryPlot& plot) {
  const std::string reference = short_name(report.reference_path);
  const std::string_view alignment = name_of(report.options.alignment);
  if (shown.size() > 1) {
    plot.title = fmt::format("{} estimates against {}", shown.size(), reference);
    plot.subtitle = fmt::format("aligned by {}; with each its ATE, rmse", alignment);
    return;
  }
  const TrajectoryEvaluation& result = shown.front()->result;
  plot.title = fmt::format("ATE {} rmse, {} poses", rmse_text(result), result.pairs.size());
  plot.subtitle =
      fmt::format("{} against {}, aligned by {}", short_name(shown.front()->path), reference, alignment);
}

/// Returns where the reference was from a second before the estimates begin to a second after they end.
std::vector<Eigen::Vector3d> reference_during(const TimeRange& range, const Trajectory& reference) {
  constexpr std::int64_t kMargin = 1'000'000'000;
  std::vector<Eigen::Vector3d> places;
  for (const auto& pose : reference) {
    const bool during = pose.stamp_ns >= range.first_ns - kMargin && pose.stamp_ns <= range.last_ns + kMargin;
    if (during) places.push_back(pose.world_from_camera.translation);
  }
  return places;
}

}  // namespace

std::string draw_evaluation(const EvaluationReport& report) {
  Shown shown;
  for (const EvaluatedTrajectory& evaluated : report.estimates)
    if (evaluated.result.status == EvaluationStatus::ok) shown.push_back(&evaluated);
  require(!shown.empty(), "an estimate is aligned");
  TrajectoryPlot plot;
  add_titles(report, shown, plot);
  const TimeRange range = time_range(shown);
  plot.reference = reference_during(range, report.reference);
  for (const EvaluatedTrajectory* evaluated : shown) {
    const std::string name =
        shown.size() == 1 ? "estimate"
                          : fmt::format("{} {}", short_name(evaluated->path), rmse_text(evaluated->result));
    plot.estimates.push_back({name, poses_of(evaluated->result, range.first_ns)});
  }
  return draw_trajectory_plot(plot);
}

}  // namespace cairn
