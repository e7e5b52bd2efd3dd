// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "cairn/map/indicators.h"
#include "cairn/survey/options.h"

namespace cairn {

/// Names the rule that a landmark fails, in the order in which failed_rule checks them.
enum class CleaningRule { frames, position_std, rms, ray_angle, depth, distance, lateral, view_angle };
constexpr std::size_t kCleaningRules = 8;

/// Returns the name of the rule, for reports: "frames", "position_std", ..., "view_angle".
[[nodiscard]] std::string_view to_string(CleaningRule rule);

/// Returns the first rule that the landmark fails, or nullopt if it passes all; a value that is not a number
/// fails. `covariance` is the landmark's own (SurveyLandmark::own_covariance), square metres.
[[nodiscard]] std::optional<CleaningRule> failed_rule(const LandmarkIndicators& indicators,
                                                      const Eigen::Matrix3d& covariance,
                                                      const CleaningOptions& options);

/// Holds how many landmarks failed each rule, by its position in CleaningRule.
using CleaningCounts = std::array<std::int64_t, kCleaningRules>;

}  // namespace cairn
