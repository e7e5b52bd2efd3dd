// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "cairn/optimize/disparity_noise_estimate.h"
#include "cairn/report/json_pieces.h"

namespace cairn {

/// Returns how sure the depth of a run was; null for no depth camera.
[[nodiscard]] Json to_json(const std::optional<DisparityNoiseEstimate>& found);

/// Returns the line that the program prints, without its end; empty for no depth camera.
[[nodiscard]] std::string describe(const std::optional<DisparityNoiseEstimate>& found);

}  // namespace cairn
