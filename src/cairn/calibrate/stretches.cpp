// SPDX-License-Identifier: Apache-2.0
#include "cairn/calibrate/stretches.h"

#include <algorithm>
#include <cmath>

#include "cairn/core/median.h"

namespace cairn {
namespace {

double seconds(const StampedPose& from, const StampedPose& to) {
  return 1e-9 * static_cast<double>(to.stamp_ns - from.stamp_ns);
}

/// Returns the median time between neighbouring poses; 0 if there are none.
double median_period(const Trajectory& trajectory) {
  std::vector<double> periods;
  for (std::size_t i = 1; i < trajectory.size(); ++i)
    periods.push_back(seconds(trajectory[i - 1], trajectory[i]));
  return periods.empty() ? 0 : median(std::move(periods));
}

/// Returns how long a stretch is to be.
double wanted_seconds(const Trajectory& trajectory) {
  constexpr double kStretches = 20, kShortest = 0.5, kLongest = 2;
  return std::clamp(seconds(trajectory.front(), trajectory.back()) / kStretches, kShortest, kLongest);
}

std::vector<Stretch> all_stretches(const Trajectory& trajectory, double period) {
  constexpr double kGap = 3, kLongest = 3;  // periods; seconds
  const double wanted = wanted_seconds(trajectory) - period / 2;
  std::vector<Stretch> stretches;
  std::size_t begin = 0;
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    const StampedPose &first = trajectory[begin], &last = trajectory[i];
    if (seconds(trajectory[i - 1], last) > std::min(kGap * period, kLongest)) {
      begin = i;
    } else if (seconds(first, last) >= wanted) {
      stretches.push_back({first.stamp_ns, last.stamp_ns,
                           Rigid3(first.world_from_camera.inverse() * last.world_from_camera)});
      begin = i;
    }
  }
  return stretches;
}

/// Returns the 0.9 quantile of a figure of the stretches.
template <class Figure>
double usual(const std::vector<Stretch>& stretches, Figure figure) {
  std::vector<double> values;
  for (const Stretch& stretch : stretches) values.push_back(figure(stretch));
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(9 * (values.size() - 1) / 10);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

}  // namespace

std::vector<Stretch> cut_stretches(const Trajectory& trajectory) {
  constexpr double kLeast = 0.2;  // of the usual motion
  if (trajectory.size() < 2) return {};
  std::vector<Stretch> stretches = all_stretches(trajectory, median_period(trajectory));
  if (stretches.empty()) return stretches;
  const auto length = [](const Stretch& s) { return s.first_from_last.translation.norm(); };
  const auto angle = [](const Stretch& s) { return rotation_angle(s.first_from_last.rotation); };
  const double least_length = kLeast * usual(stretches, length),
               least_angle = kLeast * usual(stretches, angle);
  std::erase_if(stretches,
                [&](const Stretch& s) { return length(s) <= least_length && angle(s) <= least_angle; });
  return stretches;
}

}  // namespace cairn
