// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <vector>

#include "cairn/core/executor.h"
#include "cairn/features/features.h"
#include "cairn/matching/matching.h"

namespace cairn {

/// Describes the window in which a landmark should be seen.
struct SearchWindow {
  double u = 0, v = 0;   ///< centre, pixels
  double radius_px = 0;  ///< radius around the centre
  double min_size = 0;   ///< minimum size of a keypoint that may show the landmark, pixels
  /// Maximum size of a keypoint that may show the landmark, pixels.
  double max_size = std::numeric_limits<double>::infinity();
};

/// Matches landmarks, given by windows and descriptors in the same order, with the keypoints within their
/// windows. Match::query is the landmark; mutual means that a keypoint is matched with the nearest of the
/// landmarks whose windows hold it. A window that is not finite matches nothing. Gives the same bits at any
/// number of threads and on every processor. Throws PreconditionError if there are not as many descriptors as
/// windows, an option is out of range, or the kinds of descriptor differ.
[[nodiscard]] std::vector<Match> match_predicted(const std::vector<SearchWindow>& places,
                                                 const Descriptors& descriptors, const Features& features,
                                                 const MatchOptions& options,
                                                 const Executor& executor = Executor());

}  // namespace cairn
