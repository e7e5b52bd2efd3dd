// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/localization_figures.h"

#include <cmath>
#include <utility>

#include "cairn/core/median.h"

namespace cairn {
namespace {

/// Returns nothing if no image has the value.
template <class ValueOf>
std::optional<double> median_of(const std::vector<LocalizedImage>& images, const ValueOf& value_of) {
  std::vector<double> values;
  for (const LocalizedImage& image : images)
    if (const std::optional<double> value = value_of(image)) values.push_back(*value);
  if (values.empty()) return std::nullopt;
  return median(std::move(values));
}

}  // namespace

VerdictCounts count_verdicts(const std::vector<LocalizedImage>& images) {
  VerdictCounts counts;
  for (const LocalizedImage& image : images) {
    counts.good += image.found.verdict == Verdict::good ? 1 : 0;
    counts.weak += image.found.verdict == Verdict::weak ? 1 : 0;
    counts.none += image.found.verdict == Verdict::none ? 1 : 0;
    if (image.found.verdict == Verdict::weak) ++counts.reasons[to_string(image.found.weakness)];
  }
  return counts;
}

double median_ms(const std::vector<LocalizedImage>& images, double LocalizedImage::*seconds) {
  const auto value = [&](const LocalizedImage& image) { return std::optional(image.*seconds); };
  return 1e3 * median_of(images, value).value_or(0);
}

std::optional<double> median_inliers(const std::vector<LocalizedImage>& images) {
  return median_of(images, [](const LocalizedImage& image) {
    return image.found.found() ? std::optional(static_cast<double>(image.found.inliers.size()))
                               : std::nullopt;
  });
}

std::optional<double> median_std_m(const std::vector<LocalizedImage>& images) {
  return median_of(images, [](const LocalizedImage& image) -> std::optional<double> {
    if (!image.found.found()) return std::nullopt;
    return std::sqrt(image.found.precision.covariance.diagonal().tail<3>().maxCoeff());
  });
}

std::optional<double> median_absolute_std_m(const std::vector<LocalizedImage>& images) {
  return median_of(images, [](const LocalizedImage& image) -> std::optional<double> {
    if (!image.found.found() || !image.found.precision.absolute) return std::nullopt;
    return std::sqrt(image.found.precision.absolute->diagonal().tail<3>().maxCoeff());
  });
}

std::optional<double> median_protection_m(const std::vector<LocalizedImage>& images) {
  return median_of(images, [](const LocalizedImage& image) -> std::optional<double> {
    if (!image.found.found()) return std::nullopt;
    return image.found.precision.protection.tail<3>().maxCoeff();
  });
}

}  // namespace cairn
