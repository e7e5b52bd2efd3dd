// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

#include "cairn/localize/localize_sequence.h"

namespace cairn {

/// Holds how many images had which verdict, and how many were weak for which reason.
struct VerdictCounts {
  std::size_t good = 0, weak = 0, none = 0;
  std::map<std::string_view, std::size_t> reasons;
};

/// Counts the images by their verdicts.
[[nodiscard]] VerdictCounts count_verdicts(const std::vector<LocalizedImage>& images);

/// Returns the median of one of the times of the images, milliseconds; 0 of no images.
[[nodiscard]] double median_ms(const std::vector<LocalizedImage>& images, double LocalizedImage::*seconds);

/// Returns the median number of inliers of the images with a pose; nothing if there are none.
[[nodiscard]] std::optional<double> median_inliers(const std::vector<LocalizedImage>& images);

/// Returns the median, over the images with a pose, of the largest standard deviation of the position along
/// an axis within the map, metres; nothing if there are none.
[[nodiscard]] std::optional<double> median_std_m(const std::vector<LocalizedImage>& images);
/// Returns the same of the position in the world of the poses that made the map; nothing if none knows it.
[[nodiscard]] std::optional<double> median_absolute_std_m(const std::vector<LocalizedImage>& images);

/// Returns the median, over the images with a pose, of the largest protection level of the position along an
/// axis, metres; nothing if there are none.
[[nodiscard]] std::optional<double> median_protection_m(const std::vector<LocalizedImage>& images);

}  // namespace cairn
