// SPDX-License-Identifier: Apache-2.0
#include "cairn/survey/cleaning.h"

namespace cairn {
namespace {

bool holds(const ValueLimits& limits, const ValueRange& range) {
  const auto is_at_most = [](double value, const std::optional<double>& bound) {
    return !bound || value <= *bound;
  };
  return (!limits.min || range.min >= *limits.min) && is_at_most(range.max, limits.max) &&
         is_at_most(range.mean, limits.max_mean) && is_at_most(range.std, limits.max_std);
}

}  // namespace

std::string_view to_string(CleaningRule rule) {
  constexpr std::array<std::string_view, kCleaningRules> kNames = {
      "frames", "position_std", "rms", "ray_angle", "depth", "distance", "lateral", "view_angle"};
  return kNames[static_cast<std::size_t>(rule)];
}

std::optional<CleaningRule> failed_rule(const LandmarkIndicators& indicators,
                                        const Eigen::Matrix3d& covariance, const CleaningOptions& options) {
  // A comparison with NaN is false, so each test asks for the good case.
  if (!(indicators.frames >= options.min_frames)) return CleaningRule::frames;
  if (!(largest_std(covariance) <= options.max_std_m)) return CleaningRule::position_std;
  if (!(indicators.rms_px <= options.max_rms_px)) return CleaningRule::rms;
  if (!(indicators.max_ray_angle_deg >= options.min_ray_angle_deg)) return CleaningRule::ray_angle;
  if (!holds(options.depth, indicators.depth)) return CleaningRule::depth;
  if (!holds(options.distance, indicators.distance)) return CleaningRule::distance;
  if (!holds(options.lateral, indicators.lateral)) return CleaningRule::lateral;
  if (!holds(options.angle_deg, indicators.angle_deg)) return CleaningRule::view_angle;
  return std::nullopt;
}

}  // namespace cairn
