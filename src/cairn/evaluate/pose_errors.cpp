// SPDX-License-Identifier: Apache-2.0
#include "cairn/evaluate/pose_errors.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cairn/core/error.h"

namespace cairn {
namespace {

using Intervals = std::vector<std::pair<std::size_t, std::size_t>>;

double degrees(double radians) {
  return radians * (180.0 / std::numbers::pi);
}

void append(const Eigen::Vector3d& translation, const Eigen::Quaterniond& rotation, PoseErrors& errors) {
  errors.translation_m.push_back(translation.norm());
  errors.rotation_deg.push_back(degrees(rotation_angle(rotation)));
}

Intervals successive(const std::vector<std::size_t>& marks) {
  Intervals intervals;
  for (std::size_t k = 1; k < marks.size(); ++k) intervals.emplace_back(marks[k - 1], marks[k]);
  return intervals;
}

Intervals intervals_by_frames(std::size_t count, const RpeOptions& options) {
  const double whole = std::min(options.delta, static_cast<double>(count));  // none is longer
  const auto delta = static_cast<std::size_t>(whole);
  Intervals intervals;
  for (std::size_t i = 0; i + delta < count; i += options.all_pairs ? 1 : delta)
    intervals.emplace_back(i, i + delta);
  return intervals;
}

/// Length of the estimate's path up to each pose.
std::vector<double> path_lengths(std::span<const PosePair> pairs) {
  std::vector<double> lengths(pairs.size(), 0.0);
  for (std::size_t i = 1; i < pairs.size(); ++i) {
    lengths[i] = lengths[i - 1] + (pairs[i].estimate.translation - pairs[i - 1].estimate.translation).norm();
  }
  return lengths;
}

Intervals successive_by_path(std::span<const PosePair> pairs, double delta_m) {
  std::vector<std::size_t> marks;
  double path = 0;
  for (std::size_t i = 1; i < pairs.size(); ++i) {
    path += (pairs[i].estimate.translation - pairs[i - 1].estimate.translation).norm();
    if (path < delta_m) continue;
    marks.push_back(i);
    path = 0;
  }
  return successive(marks);
}

/// Position after `i` of the value nearest to `value`, the first of equals; `values` increase, i + 1 exists.
template <class Values, class Value>
std::size_t nearest_after(const Values& values, std::size_t i, Value value) {
  const auto begin = values.begin() + static_cast<std::ptrdiff_t>(i) + 1;
  auto found = std::lower_bound(begin, values.end(), value);
  if (found == values.end() || (found != begin && value - *(found - 1) <= *found - value)) --found;
  found = std::lower_bound(begin, values.end(), *found);
  return static_cast<std::size_t>(found - values.begin());
}

Intervals all_by_path(std::span<const PosePair> pairs, double delta_m) {
  constexpr double kTolerance = 0.1;  // evo's rel_delta_tol
  const std::vector<double> lengths = path_lengths(pairs);
  Intervals intervals;
  for (std::size_t i = 0; i + 1 < lengths.size(); ++i) {
    const std::size_t j = nearest_after(lengths, i, lengths[i] + delta_m);
    if (std::abs(lengths[j] - lengths[i] - delta_m) <= kTolerance * delta_m) intervals.emplace_back(i, j);
  }
  return intervals;
}

Intervals all_by_time(std::span<const PosePair> pairs, double delta_s) {
  std::vector<std::int64_t> stamps;
  for (const auto& pair : pairs) stamps.push_back(pair.stamp_ns);
  const std::int64_t delta_ns = std::llround(1e9 * delta_s);
  Intervals intervals;
  for (std::size_t i = 0; i + 1 < stamps.size(); ++i) {
    const std::size_t j = nearest_after(stamps, i, stamps[i] + delta_ns);
    if (j + 1 != stamps.size()) intervals.emplace_back(i, j);
  }
  return intervals;
}

}  // namespace

void RpeOptions::validate() const {
  constexpr double kMaxDelta = 1e6;
  require(delta > 0 && delta <= kMaxDelta, "delta of the RPE is above 0 and at most 1e6");
  require(unit != RpeUnit::frames || (delta >= 1 && delta == std::floor(delta)),
          "delta of the RPE in frames is a whole number");
}

PoseErrors absolute_errors(std::span<const PosePair> pairs) {
  PoseErrors errors;
  for (const auto& [stamp, estimate, reference] : pairs) {
    append(estimate.translation - reference.translation, estimate.rotation.conjugate() * reference.rotation,
           errors);
  }
  return errors;
}

Intervals rpe_intervals(std::span<const PosePair> pairs, const RpeOptions& options) {
  options.validate();
  if (options.unit == RpeUnit::frames) return intervals_by_frames(pairs.size(), options);
  if (options.unit == RpeUnit::seconds) return all_by_time(pairs, options.delta);
  return options.all_pairs ? all_by_path(pairs, options.delta) : successive_by_path(pairs, options.delta);
}

PoseErrors relative_errors(std::span<const PosePair> pairs,
                           std::span<const std::pair<std::size_t, std::size_t>> intervals) {
  PoseErrors errors;
  for (const auto& [i, j] : intervals) {
    require(i < pairs.size() && j < pairs.size(), "intervals lie inside the pairs");
    const Rigid3 reference = pairs[i].reference.inverse() * pairs[j].reference;
    const Rigid3 estimate = pairs[i].estimate.inverse() * pairs[j].estimate;
    const Rigid3 error = reference.inverse() * estimate;
    append(error.translation, error.rotation, errors);
  }
  return errors;
}

std::size_t count_within(const PoseErrors& errors, const PoseTolerance& tolerance) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < errors.translation_m.size(); ++i) {
    const bool within = errors.translation_m[i] <= tolerance.translation_m &&
                        errors.rotation_deg[i] <= tolerance.rotation_deg;
    count += within ? 1 : 0;
  }
  return count;
}

}  // namespace cairn
