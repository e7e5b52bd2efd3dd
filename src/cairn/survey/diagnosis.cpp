// SPDX-License-Identifier: Apache-2.0
#include "cairn/survey/diagnosis.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include "cairn/core/median.h"
#include "cairn/map/indicators.h"

namespace cairn {
namespace {

double median_or_zero(std::vector<double> values) {
  return values.empty() ? 0 : median(std::move(values));
}

std::int64_t sum_of(const CleaningCounts& cleaned) {
  return std::accumulate(cleaned.begin(), cleaned.end(), std::int64_t{0});
}

/// Returns the parameter of the rule, with its value if it is one number, and what a landmark that fails it
/// lacks.
std::string describe_rule(CleaningRule rule, const CleaningOptions& options) {
  switch (rule) {
    case CleaningRule::frames:
      return fmt::format("clean.min_frames ({}): features are lost after few frames", options.min_frames);
    case CleaningRule::position_std:
      return fmt::format(
          "clean.max_std_m ({:g} m, without what the poses' deviations add): the images see landmarks from "
          "too "
          "near together, or are too noisy, for their distance",
          options.max_std_m);
    case CleaningRule::rms:
      return fmt::format("clean.max_rms_px ({:g} px): poses, calibration and images do not agree",
                         options.max_rms_px);
    case CleaningRule::ray_angle:
      return fmt::format(
          "clean.min_ray_angle_deg ({:g}): the camera hardly moved, or its path is in other units",
          options.min_ray_angle_deg);
    case CleaningRule::depth:
      return "clean.depth.*: look at the baseline, or at the depth's scale, in the calibration";
    case CleaningRule::distance:
      return "clean.distance.*: look at the baseline, or at the depth's scale, in the calibration";
    case CleaningRule::lateral:
      return "clean.lateral.*: look at the focal length in the calibration";
    case CleaningRule::view_angle:
      break;
  }
  return "clean.angle_deg.*: look at the focal length in the calibration";
}

std::string describe_poses(const SurveyResult& result) {
  std::string text;
  if (result.pose_check.pairs > 0)
    text += fmt::format(" Against the images: {}.", describe(result.pose_check));
  if (result.stated.position_m > 0 || result.stated.rotation_deg > 0)
    text += fmt::format(" The poses state deviations of {:.2g} m and {:.2g} degrees.",
                        result.stated.position_m, result.stated.rotation_deg);
  return text;
}

std::string likely_cause(const SurveyResult& result, const SurveyOptions& options) {
  const SurveyCounts& counts = result.counts;
  if (counts.features == 0) return "The images show no features: look at their brightness and sharpness.";
  if (counts.measured == 0)
    return fmt::format(
        "None of {} features has a depth: look at the baseline, or at the depth's scale, in the calibration.",
        counts.features);
  // Even in a good drive most tracks are short: this says something only if hardly any became a landmark.
  constexpr std::int64_t kHardlyOne = 10;
  const std::int64_t made = sum_of(counts.cleaned);
  const auto worst = std::max_element(counts.cleaned.begin(), counts.cleaned.end());
  if (made > 0 && made >= counts.inconsistent && kHardlyOne * made >= counts.tracks) {
    const auto rule = static_cast<CleaningRule>(worst - counts.cleaned.begin());
    return fmt::format("Most landmarks, {} of {}, fell to {}.", *worst, made,
                       describe_rule(rule, options.cleaning)) +
           describe_poses(result);
  }
  const bool lost = counts.too_short >= counts.inconsistent;
  return fmt::format("{}: look at the poses, their clock (--pose-offset) and the calibration.",
                     lost ? "Most features are not found again where the poses place them"
                          : "What most tracks show fits no point as the poses have it") +
         describe_poses(result);
}

}  // namespace

StatedDeviations stated_deviations(const GivenPoses& poses) {
  std::vector<double> positions, rotations;
  for (const auto& pose : poses.frames) {
    if (!pose || !pose->uncertainty) continue;
    positions.push_back(largest_std(pose->uncertainty->position));
    rotations.push_back(largest_std(pose->uncertainty->rotation) * 180 / std::numbers::pi);
  }
  return {median_or_zero(std::move(positions)), median_or_zero(std::move(rotations))};
}

std::string explain_no_landmarks(const SurveyResult& result, const SurveyOptions& options) {
  const SurveyCounts& counts = result.counts;
  return fmt::format(
      "not one landmark: {} tracks of features, {} in too few frames, {} that contradict the poses, {} that "
      "fell "
      "to a limit.\n  {}",
      counts.tracks, counts.too_short, counts.inconsistent, sum_of(counts.cleaned),
      likely_cause(result, options));
}

std::string describe_dominant_poses(const SurveyResult& result) {
  const SurveyCounts& counts = result.counts;
  const bool of_most = 2 * counts.dominated_by_poses > counts.landmarks;
  if (!of_most || result.pose_std_rms_m <= result.image_std_rms_m) return {};
  return fmt::format(
      "the poses' stated deviations dominate: to {} of {} landmarks they add more ({:.2g} m, root mean "
      "square "
      "along the worst direction) than the images leave open ({:.2g} m); neighbouring landmarks err alike",
      counts.dominated_by_poses, counts.landmarks, result.pose_std_rms_m, result.image_std_rms_m);
}

}  // namespace cairn
