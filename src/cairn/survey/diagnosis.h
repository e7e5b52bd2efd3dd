// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cairn/survey/survey.h"

namespace cairn {

/// Computes the medians of the standard deviations that the given poses state.
[[nodiscard]] StatedDeviations stated_deviations(const GivenPoses& poses);

/// Says why a run made no landmark, from its counts: where most tracks were lost, and what to check then. Two
/// lines without a line break at the end. `result` has no landmarks.
[[nodiscard]] std::string explain_no_landmarks(const SurveyResult& result, const SurveyOptions& options);

/// Says, with the figures, that the poses' stated deviations contribute more to the landmarks' standard
/// deviations than the images do, both for most landmarks and in the root mean square over all. Returns one
/// line, empty if they do not.
[[nodiscard]] std::string describe_dominant_poses(const SurveyResult& result);

}  // namespace cairn
