// SPDX-License-Identifier: Apache-2.0
#include "evaluate_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>

#include "cairn/core/text.h"
#include "cairn/report/trajectory_plot.h"

namespace cairn::app {
namespace {

std::string time_range(const Trajectory& trajectory) {
  return fmt::format("{} to {} s, {} poses", format_stamp(trajectory.front().stamp_ns),
                     format_stamp(trajectory.back().stamp_ns), trajectory.size());
}

std::string_view reason(AlignmentStatus status) {
  switch (status) {
    case AlignmentStatus::too_few_points:
      return "fewer than 3 pairs of poses do not determine it";
    case AlignmentStatus::one_place:
      return "all poses of one trajectory are at one place";
    case AlignmentStatus::one_line:
      return "all poses of one trajectory lie on one line, so the turn about it is free";
    case AlignmentStatus::ok:
      break;
  }
  return "";
}

double percent(std::size_t part, std::size_t whole) {
  return 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

struct ShownUnit {
  std::string_view name;
  double factor;  ///< in a metre, or 1 for degrees
};

/// Centimetres, or metres where they would need more than five digits.
ShownUnit unit_for(const ErrorStatistics& errors_m) {
  constexpr double kFarM = 10;
  return errors_m.max < kFarM ? ShownUnit{"cm", 100} : ShownUnit{"m", 1};
}

void print_row(std::string_view name, const ShownUnit& unit, const std::optional<ErrorStatistics>& errors) {
  if (!errors) return;
  const auto& e = *errors;
  const double factor = unit.factor;
  fmt::print("{:<16} {:>4} {:>9.3f} {:>9.3f} {:>9.3f} {:>9.3f} {:>9.3f} {:>9.3f}\n", name, unit.name,
             factor * e.rmse, factor * e.mean, factor * e.median, factor * e.std, factor * e.min,
             factor * e.max);
}

std::string describe_alignment(const EvaluateArguments& arguments, const TrajectoryEvaluation& result) {
  if (arguments.options.alignment == AlignmentMode::none) return "none: both in one frame";
  const Similarity3& map = result.reference_from_estimate;
  std::string text = fmt::format("{}: turned {:.2f} deg", arguments.align,
                                 180.0 / std::numbers::pi * rotation_angle(map.rotation));
  text += fmt::format(", moved {:.3f} m", map.translation.norm());
  if (arguments.options.alignment == AlignmentMode::sim3) text += fmt::format(", scale {:.6f}", map.scale);
  return text;
}

void add_statistics(nlohmann::ordered_json& json, const std::string& name, const std::string& unit,
                    const std::optional<ErrorStatistics>& errors) {
  const auto put = [&](const char* statistic, double ErrorStatistics::*value) {
    const auto key = fmt::format("{}_{}_{}", name, statistic, unit);
    json[key] = errors ? nlohmann::ordered_json((*errors).*value) : nullptr;
  };
  put("rmse", &ErrorStatistics::rmse);
  put("mean", &ErrorStatistics::mean);
  put("median", &ErrorStatistics::median);
  put("std", &ErrorStatistics::std);
  put("min", &ErrorStatistics::min);
  put("max", &ErrorStatistics::max);
}

/// A longer step than this many medians means that poses are missing.
std::int64_t longest_step_ns(const std::vector<PosePair>& pairs) {
  constexpr std::int64_t kMedians = 5;
  std::vector<std::int64_t> steps;
  for (std::size_t i = 1; i < pairs.size(); ++i) steps.push_back(pairs[i].stamp_ns - pairs[i - 1].stamp_ns);
  if (steps.empty()) return 0;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return kMedians * *middle;
}

/// The last two parts of a path: "run/trajectory.txt".
std::string short_name(const std::string& path) {
  const std::filesystem::path whole = std::filesystem::path(path).lexically_normal();
  const auto named = whole.has_filename() ? whole : whole.parent_path();
  return (named.parent_path().filename() / named.filename()).string();
}

}  // namespace

int print_failure(const Evaluated& evaluated) {
  const auto& [arguments, estimate, reference, result] = evaluated;
  if (result.status == EvaluationStatus::no_pairs) {
    fmt::print(
        stderr,
        "cairn: no pose of EST is within {} s of a pose of REF.\n  EST {}\n  REF {}\n"
        "  If the times overlap, raise --max-gap; if not, the clocks differ or the files do not belong "
        "together.\n",
        arguments.options.max_gap_s, time_range(estimate), time_range(reference));
  } else {
    fmt::print(stderr, "cairn: no alignment by {} from {} pairs: {}.\n  Compare without: --align none.\n",
               arguments.align, result.pairs.size(), reason(result.alignment_status));
  }
  return 1;
}

void print_evaluation(const Evaluated& evaluated) {
  const auto& [arguments, estimate, reference, result] = evaluated;
  const std::size_t pairs = result.pairs.size();
  fmt::print("pairs      {} ({:.1f} % of EST, {:.1f} % of REF), stamps within {} s\n", pairs,
             percent(pairs, estimate.size()), percent(pairs, reference.size()), arguments.options.max_gap_s);
  fmt::print("alignment  {}\n\n", describe_alignment(arguments, result));
  fmt::print("{:<16} {:>4} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9}\n", "", "", "rmse", "mean", "median", "std",
             "min", "max");
  const ShownUnit shown = unit_for(*result.ate_m);
  print_row("ATE translation", shown, result.ate_m);
  print_row("ATE rotation", {"deg", 1}, result.ate_deg);
  print_row("RPE translation", shown, result.rpe_m);
  print_row("RPE rotation", {"deg", 1}, result.rpe_deg);
  const std::string delta = fmt::format("{} {}", arguments.options.rpe.delta, arguments.rpe_unit);
  if (result.rpe_m) {
    fmt::print("\nRPE over {} intervals of {}\n", result.rpe_m->count, delta);
  } else {
    fmt::print("\nno RPE: no interval of {} among the pairs\n", delta);
  }
}

void print_evaluation_json(const Evaluated& evaluated) {
  const auto& [arguments, estimate, reference, result] = evaluated;
  const Similarity3& map = result.reference_from_estimate;
  nlohmann::ordered_json json;
  json["pairs"] = result.pairs.size();
  json["estimate_poses"] = estimate.size();
  json["reference_poses"] = reference.size();
  json["max_gap_s"] = arguments.options.max_gap_s;
  json["alignment"] = arguments.align;
  json["scale"] = map.scale;
  json["rotation_xyzw"] = {map.rotation.x(), map.rotation.y(), map.rotation.z(), map.rotation.w()};
  json["translation_m"] = {map.translation.x(), map.translation.y(), map.translation.z()};
  add_statistics(json, "ate", "m", result.ate_m);
  add_statistics(json, "ate", "deg", result.ate_deg);
  json["rpe_delta"] = arguments.options.rpe.delta;
  json["rpe_unit"] = arguments.rpe_unit;
  json["rpe_all_pairs"] = arguments.options.rpe.all_pairs;
  json["rpe_intervals"] = result.rpe_m ? result.rpe_m->count : 0;
  add_statistics(json, "rpe", "m", result.rpe_m);
  add_statistics(json, "rpe", "deg", result.rpe_deg);
  fmt::print("{}\n", json.dump(2));
}

std::string draw_evaluation(const Evaluated& evaluated) {
  const auto& [arguments, estimate, reference, result] = evaluated;
  TrajectoryPlot plot;
  const ShownUnit shown = unit_for(*result.ate_m);
  plot.title = fmt::format("ATE {:.2f} {} rmse, {} poses", shown.factor * result.ate_m->rmse, shown.name,
                           result.pairs.size());
  plot.subtitle = fmt::format("{} against {}, aligned by {}", short_name(arguments.estimate),
                              short_name(arguments.reference), arguments.align);
  const std::int64_t first = result.pairs.front().stamp_ns, last = result.pairs.back().stamp_ns;
  for (const auto& pose : reference) {
    const bool during = pose.stamp_ns >= first - 1'000'000'000 && pose.stamp_ns <= last + 1'000'000'000;
    if (during) plot.reference.push_back(pose.world_from_camera.translation);
  }
  const std::int64_t longest = longest_step_ns(result.pairs);
  for (std::size_t i = 0; i < result.pairs.size(); ++i) {
    const bool connected = i > 0 && result.pairs[i].stamp_ns - result.pairs[i - 1].stamp_ns <= longest;
    plot.estimate.push_back(
        {result.pairs[i].estimate.translation, result.absolute.translation_m[i], connected});
  }
  return draw_trajectory_plot(plot);
}

}  // namespace cairn::app
