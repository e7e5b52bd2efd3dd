// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "cairn/survey/landmarks.h"

namespace cairn {

/// Merges each of `added` that shows the same thing as one of `pending` with it, and appends the others:
/// where the difference of the points is at most `duplicate_sigmas` standard deviations, their descriptors
/// are alike in the two sightings that are nearest in time, and one point fits nearly all sightings of both.
/// Returns how many were merged. All frames are in the buffer.
std::int64_t merge_duplicates(const Rig& rig, const FrameBuffer& frames, const VariancePrior& prior,
                              std::vector<SurveyLandmark>&& added, const SurveyOptions& options,
                              std::vector<SurveyLandmark>& pending);

}  // namespace cairn
