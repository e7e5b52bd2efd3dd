// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cairn/evaluate/evaluation.h"
#include "common.h"
#include "pose_arguments.h"

namespace cairn::app {

struct EvaluateArguments {
  CommonOptions common;
  std::vector<std::string> estimates;
  std::vector<std::string> within;  ///< --within M,DEG
  std::vector<PoseTolerance> tolerances;
  std::optional<std::int64_t> queries;
  std::string reference, camera, align = "se3", rpe_unit = "frames", plot;
  StampOffset offset;                    ///< added to the estimates' stamps
  bool has_times = true;                 ///< false: poses pair by position or number, no file says a time
  std::vector<double> rpe_deltas = {1};  ///< in rpe_unit
  bool rpe_all_pairs = false;
  EvaluationOptions options;
};

/// An evaluation with what it is of.
struct Evaluated {
  std::string path;  ///< as it was given
  Trajectory estimate;
  TrajectoryEvaluation result;
};

struct Evaluations {
  const EvaluateArguments& arguments;
  const Trajectory& reference;
  std::vector<Evaluated> estimates;  ///< in the order of the command line
  /// For each estimate: ComparedTrajectories::start_offsets_ns.
  std::vector<std::int64_t> start_offsets_ns = {};
};

/// On stdout: all figures of one estimate, or a row for each of several.
void print_evaluations(const Evaluations& evaluations);
/// One object on stdout, all figures in full.
void print_evaluations_json(const Evaluations& evaluations);
/// On stderr: why there is nothing to compare and what to do, where that is so; what to beware of elsewhere.
void print_doubts(const Evaluations& evaluations, const Evaluated& evaluated);
/// The picture of --plot, an SVG file, of those that could be evaluated.
[[nodiscard]] std::string draw_evaluations(const Evaluations& evaluations);

/// By what poses pair: "stamps within 0.02 s", or their position where no file says a time.
[[nodiscard]] std::string describe_pairing(const EvaluateArguments& arguments);

/// The percentiles that are told of errors.
inline constexpr double kPercents[] = {50, 90, 95, 99};

/// How many poses are within a tolerance.
struct WithinCount {
  PoseTolerance tolerance;
  std::size_t count = 0;
};
/// One for each of --within.
[[nodiscard]] std::vector<WithinCount> count_within_each(const EvaluateArguments& arguments,
                                                         const TrajectoryEvaluation& result);
/// Percentiles of the errors of each estimate, and how many poses are within the tolerances: of what share.
void print_shares(const Evaluations& evaluations);

/// Rows of one table: the first column to the left, the others to the right.
using Row = std::vector<std::string>;
void print_table(const std::vector<Row>& rows);

/// "1 frame", "10 m", "0.5 s".
[[nodiscard]] std::string name_of(const RpeOptions& options);
[[nodiscard]] std::string_view name_of(RpeUnit unit);

struct ShownUnit {
  std::string_view name;
  double factor;  ///< in a metre, or 1 for degrees
};
/// Centimetres, or metres where an error would need more than five digits.
[[nodiscard]] ShownUnit unit_for(double largest_error_m);

}  // namespace cairn::app
