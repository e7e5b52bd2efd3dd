// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "cairn/survey/landmarks.h"

namespace cairn {

/// What merging needs to know beside the landmarks. All frames that they were seen in are in the buffer.
struct MergeInput {
  const Rig& rig;
  const FrameBuffer& frames;
  const VariancePrior& prior;
  const SurveyOptions& options;
};

/// Merges each of `added` that shows the same thing as one of `pending` with it, and appends the others. Two
/// show the same if the difference of the points is at most `duplicate_sigmas` standard deviations, their
/// descriptors are alike in the two observations that are nearest in time, one point fits nearly all
/// observations of both, and that point holds against all limits of cleaning. Returns how many were merged.
std::int64_t merge_duplicates(const MergeInput& input, std::vector<SurveyLandmark>&& added,
                              std::vector<SurveyLandmark>& pending);

}  // namespace cairn
