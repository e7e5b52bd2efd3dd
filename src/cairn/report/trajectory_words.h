// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "cairn/evaluate/evaluation.h"
#include "cairn/evaluate/pose_errors.h"
#include "cairn/geometry/alignment.h"

namespace cairn {

/// Returns the last two parts of a path: "run/trajectory.txt".
[[nodiscard]] std::string short_name(const std::string& path);

/// Returns "none", "se3" or "sim3".
[[nodiscard]] std::string_view name_of(AlignmentMode alignment);
/// Returns "frames", "metres" or "seconds".
[[nodiscard]] std::string_view name_of(RpeUnit unit);
/// Returns the length of the intervals: "1 frame", "10 m", "0.5 s".
[[nodiscard]] std::string name_of(const RpeOptions& options);

/// Returns the status in one word, for JSON: "ok", "too_few_points", ...
[[nodiscard]] std::string_view word_for(AlignmentStatus status);
/// Returns the status in one word, for JSON: "ok", "no_pairs" or "not_alignable".
[[nodiscard]] std::string_view word_for(EvaluationStatus status);
/// Says why there is no alignment, as part of a sentence; empty for ok.
[[nodiscard]] std::string_view explain(AlignmentStatus status);

/// Holds a unit in which a length or an angle is shown.
struct ShownUnit {
  std::string_view name;
  double factor = 1;  ///< of these units in a metre; 1 for degrees
};
/// Returns centimetres, or metres if an error of that size would need more than five digits.
[[nodiscard]] ShownUnit unit_for(double largest_error_m);

}  // namespace cairn
