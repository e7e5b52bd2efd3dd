// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cairn/report/evaluation_report.h"

namespace cairn {

/// Returns the percentiles of the errors of each estimate, and a table for each tolerance: how many poses are
/// within, and of what share. Each table begins with an empty line. Estimates that were not aligned have "-".
[[nodiscard]] std::string format_evaluation_shares(const EvaluationReport& report);

/// Returns a table with a row of RMS errors for each of several estimates, and a line about what they have in
/// common before it.
[[nodiscard]] std::string format_evaluation_table(const EvaluationReport& report);

/// Returns by what poses pair: "stamps within 0.02 s", or their order if no file says a time.
[[nodiscard]] std::string describe_pairing(const EvaluationReport& report);

}  // namespace cairn
