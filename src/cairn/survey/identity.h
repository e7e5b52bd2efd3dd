// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "cairn/survey/survey.h"

namespace cairn {

/// Returns a checksum of all that the map of a run depends on: the program's version, settings, calibration,
/// the frames with their images (names, sizes, times of modification), the given poses with their
/// covariances, and their origin. Work kept under another number is not resumed.
[[nodiscard]] std::uint32_t identity_of(const SurveyInput& input);

}  // namespace cairn
