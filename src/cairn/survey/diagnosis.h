// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cairn/survey/survey.h"

namespace cairn {

/// Of given poses.
[[nodiscard]] StatedDeviations stated_deviations(const GivenPoses& poses);

/// Says why a run made no landmark, by its figures: what most tracks fell to, and what to look at then. Two
/// lines without a line break at the end. The result has no landmarks.
[[nodiscard]] std::string explain_no_landmarks(const SurveyResult& result, const SurveyOptions& options);

/// Says that the poses' stated deviations make more of the landmarks' standard deviations than the images do,
/// of most landmarks and over all (root mean square), with the figures; empty if they do not. One line.
[[nodiscard]] std::string describe_dominant_poses(const SurveyResult& result);

}  // namespace cairn
