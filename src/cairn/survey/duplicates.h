// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "cairn/survey/landmarks.h"

namespace cairn {

/// Holds what merging needs beside the landmarks. The buffer has all frames that they were seen in.
struct MergeInput {
  const Rig& rig;
  const FrameBuffer& frames;
  const VariancePrior& prior;
  const SurveyOptions& options;
};

/// Merges each of `added` that shows the same thing as one of `pending` with it, and appends the others to
/// `pending`. Two landmarks are merged if the difference of the points is at most `duplicate_sigmas` standard
/// deviations, their descriptors are alike in the two observations that are nearest in time, one point fits
/// nearly all observations of both, and that point passes all rules of cleaning. Returns how many were
/// merged.
std::int64_t merge_duplicates(const MergeInput& input, std::vector<SurveyLandmark>&& added,
                              std::vector<SurveyLandmark>& pending);

}  // namespace cairn
