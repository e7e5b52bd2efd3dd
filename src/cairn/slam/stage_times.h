// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace cairn {

/// Wall-clock seconds by stage, one for each time it ran. Decoding and features run beside tracking, as does
/// the adjustment of the window.
struct StageTimes {
  std::vector<double> decode, features;  ///< per frame
  std::vector<double> tracking;          ///< per frame
  std::vector<double> mapping;           ///< per keyframe: landmarks and observations
  std::vector<double> window;            ///< per keyframe: bundle adjustment
  std::vector<double> loops;             ///< per keyframe
  std::vector<double> global;            ///< at the end: bundle adjustment of the whole
};

/// Of the times of a stage: their sum, median and 95th percentile; zeros of none.
struct TimeSummary {
  double total = 0, median = 0, percentile_95 = 0;
};

[[nodiscard]] TimeSummary summarize(std::vector<double> seconds);

}  // namespace cairn
