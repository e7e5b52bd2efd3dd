// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "cairn/slam/slam.h"

namespace cairn {

/// Returns keyframe_covariances.csv: lines with # that explain it, a line of names, then a row for each
/// keyframe of keyframes.txt; empty columns where a covariance is not known.
[[nodiscard]] std::string format_keyframe_covariances(const SlamResult& result);

/// Says how sure the last keyframe is against the first one: root mean squares of the error that is expected.
struct KeyframePrecision {
  double position_m = 0, rotation_deg = 0;
};

/// Returns nullopt if the trajectory has fewer than two keyframes, or the covariance is not known.
[[nodiscard]] std::optional<KeyframePrecision> last_keyframe_precision(const SlamResult& result);

}  // namespace cairn
