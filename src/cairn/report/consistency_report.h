// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "cairn/evaluate/consistency.h"
#include "cairn/evaluate/pose_consistency.h"
#include "cairn/report/evaluation_report.h"
#include "cairn/report/json_pieces.h"

namespace cairn {

/// Names what errors are measured in; mixed: no length of theirs is told.
enum class ErrorUnit : std::uint8_t { mixed, metres, radians };

/// Holds a row of a table of consistencies.
struct ConsistencyRow {
  std::string name;
  ErrorConsistency consistency;
  ErrorUnit unit = ErrorUnit::metres;
};

/// Returns a table with a row for each: number of errors, mean NEES per degree of freedom, median NEES over
/// that of chi-square, observed shares in percent, medians of stated standard deviation and error, their
/// ratio and what it is if honest; a last row says what the others are if honest. `head` names the first
/// column, `what` the errors.
[[nodiscard]] std::string format_consistencies(const std::string& head, const std::string& what,
                                               const std::vector<ConsistencyRow>& rows);

/// Returns the figures of a row in full: metres or degrees, as the keys say.
[[nodiscard]] Json consistency_json(const ErrorConsistency& consistency, ErrorUnit unit);

/// Returns "honest", "overconfident" or "pessimistic".
[[nodiscard]] std::string_view word_for(CovarianceVerdict verdict);
/// Returns "absolute", "in_map", "from_first" or "from_previous".
[[nodiscard]] std::string_view word_for(CovarianceScope scope);

/// Returns what the estimates' covariances are found to be, a table with an empty line before it and
/// sentences about it; empty if none was stated.
[[nodiscard]] std::string format_stated_poses(const EvaluationReport& report);

/// Returns a list of what was found of each set of covariances.
[[nodiscard]] Json stated_poses_json(const std::vector<StatedPoses>& covariances);

}  // namespace cairn
