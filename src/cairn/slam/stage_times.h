// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace cairn {

/// Holds the wall-clock times of the stages, seconds, one for each time a stage ran. Decoding, features and
/// the adjustment of the window run beside tracking.
struct StageTimes {
  std::vector<double> decode, features;  ///< per frame
  std::vector<double> tracking;          ///< per frame
  std::vector<double> mapping;           ///< per keyframe: landmarks and observations
  std::vector<double> window;            ///< per keyframe: bundle adjustment
  std::vector<double> loops;             ///< per keyframe
  std::vector<double> global;            ///< per component, at the end: bundle adjustment of the whole
};

/// Holds the sum, median and 95th percentile of the times of a stage, seconds; zeros without any.
struct TimeSummary {
  double total = 0, median = 0, percentile_95 = 0;
};

/// Summarises times; percentiles are by nearest rank.
[[nodiscard]] TimeSummary summarize(std::vector<double> seconds);

}  // namespace cairn
