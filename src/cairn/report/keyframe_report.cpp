// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/keyframe_report.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "cairn/core/text.h"
#include "cairn/report/covariance_columns.h"

namespace cairn {
namespace {

constexpr std::size_t kColumns = 21;  // of a covariance: its upper triangle, row by row

/// Returns the keyframes of keyframes.txt.
std::vector<KeyframeId> listed_keyframes(const SlamResult& result) {
  std::vector<KeyframeId> ids;
  const std::int32_t component = result.main_component();
  for (const Keyframe& keyframe : result.map.keyframes())
    if (!keyframe.erased && keyframe.component == component && keyframe.observed.frame.valid())
      ids.push_back(keyframe.id);
  return ids;
}

KeyframeCovariance covariance_of(const SlamResult& result, KeyframeId id) {
  const auto k = static_cast<std::size_t>(id.value);
  return k < result.keyframe_covariances.size() ? result.keyframe_covariances[k] : KeyframeCovariance{};
}

std::string format_covariance(const std::optional<Matrix6d>& covariance) {
  return covariance ? format_covariance_values(*covariance) : std::string(kColumns, ',');
}

}  // namespace

std::string format_keyframe_covariances(const SlamResult& result) {
  std::string text =
      "# How sure the keyframes of keyframes.txt are: covariances of the estimated motion from the first "
      "keyframe (first_) and from the keyframe before (previous_) to this one, as the adjustment of the "
      "whole "
      "map and its residuals have them.\n"
      "# Axes are this keyframe's camera's: x right, y down, z forward; rx ry rz are rotations about them. "
      "Radians and metres, of the left perturbation (rx ry rz x y z) of this_camera_from_first_camera "
      "(from_previous_camera).\n"
      "# An error of the stated baseline or of the scale of depth is in no residual and not counted: it "
      "changes all distances by the same factor. Empty: not known, or no keyframe before.\n"
      "stamp_s" +
      format_covariance_names("first_cov_") + format_covariance_names("previous_cov_") + "\n";
  for (const KeyframeId id : listed_keyframes(result)) {
    const KeyframeCovariance covariance = covariance_of(result, id);
    text += format_stamp(result.map[id].observed.stamp_ns) + format_covariance(covariance.from_first) +
            format_covariance(covariance.from_previous) + "\n";
  }
  return text;
}

std::optional<KeyframePrecision> last_keyframe_precision(const SlamResult& result) {
  const std::vector<KeyframeId> ids = listed_keyframes(result);
  if (ids.size() < 2) return std::nullopt;
  const auto covariance = covariance_of(result, ids.back()).from_first;
  if (!covariance) return std::nullopt;
  const Vector6d variances = covariance->diagonal();
  return KeyframePrecision{std::sqrt(variances.tail<3>().sum()),
                           std::sqrt(variances.head<3>().sum()) * 180 / std::numbers::pi};
}

}  // namespace cairn
