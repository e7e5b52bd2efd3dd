// SPDX-License-Identifier: Apache-2.0
#include "cairn/evaluate/drift.h"

#include <algorithm>
#include <numeric>

#include "cairn/core/error.h"
#include "cairn/evaluate/pose_errors.h"

namespace cairn {
namespace {

using Intervals = std::vector<std::pair<std::size_t, std::size_t>>;

/// Length of the reference's path up to each pose.
std::vector<double> path_lengths(std::span<const PosePair> pairs) {
  std::vector<double> lengths(pairs.size(), 0.0);
  for (std::size_t i = 1; i < pairs.size(); ++i) {
    lengths[i] =
        lengths[i - 1] + (pairs[i].reference.translation - pairs[i - 1].reference.translation).norm();
  }
  return lengths;
}

Intervals segments_of(const std::vector<double>& path, double length_m, std::size_t step) {
  Intervals segments;
  for (std::size_t i = 0; i < path.size(); i += step) {
    const auto end = std::upper_bound(path.begin(), path.end(), path[i] + length_m);
    if (end == path.end()) break;
    segments.emplace_back(i, static_cast<std::size_t>(end - path.begin()));
  }
  return segments;
}

double mean_per_metre(const std::vector<double>& errors, double length_m) {
  const double sum = std::accumulate(errors.begin(), errors.end(), 0.0);
  return sum / (length_m * static_cast<double>(errors.size()));
}

DriftFigures figures_of(const PoseErrors& errors, double length_m) {
  return {length_m, errors.translation_m.size(), 100 * mean_per_metre(errors.translation_m, length_m),
          mean_per_metre(errors.rotation_deg, length_m)};
}

DriftFigures mean_of(const std::vector<DriftFigures>& parts) {
  DriftFigures mean;
  for (const auto& part : parts) {
    const auto weight = static_cast<double>(part.segments);
    mean.segments += part.segments;
    mean.translation_percent += weight * part.translation_percent;
    mean.rotation_deg_per_m += weight * part.rotation_deg_per_m;
  }
  mean.translation_percent /= static_cast<double>(mean.segments);
  mean.rotation_deg_per_m /= static_cast<double>(mean.segments);
  return mean;
}

}  // namespace

void DriftOptions::validate() const {
  require(step >= 1, "step of the drift is at least 1 frame");
  require(std::all_of(lengths_m.begin(), lengths_m.end(), [](double length) { return length > 0; }),
          "lengths of the drift are above 0");
}

std::optional<Drift> measure_drift(std::span<const PosePair> pairs, const DriftOptions& options) {
  options.validate();
  const std::vector<double> path = path_lengths(pairs);
  Drift drift;
  for (const double length_m : options.lengths_m) {
    const Intervals segments = segments_of(path, length_m, options.step);
    // the translation of E is as long as that of its inverse, which is the RPE's
    if (!segments.empty()) drift.by_length.push_back(figures_of(relative_errors(pairs, segments), length_m));
  }
  if (drift.by_length.empty()) return std::nullopt;
  drift.all = mean_of(drift.by_length);
  return drift;
}

}  // namespace cairn
