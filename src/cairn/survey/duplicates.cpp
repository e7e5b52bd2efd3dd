// SPDX-License-Identifier: Apache-2.0
#include "cairn/survey/duplicates.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>
#include <tuple>

#include "cairn/matching/matching.h"
#include "cairn/survey/cleaning.h"

namespace cairn {
namespace {

/// Indexes points by cells, to find those near a position.
class CellIndex {
 public:
  void add(const Eigen::Vector3d& point, std::size_t number) { cells_[cell_of(point)].push_back(number); }
  void remove(const Eigen::Vector3d& point, std::size_t number) {
    std::erase(cells_[cell_of(point)], number);
  }
  /// Returns the points in the cells that the ball touches, by cell.
  [[nodiscard]] std::vector<std::size_t> near(const Eigen::Vector3d& point, double radius) const {
    const auto [x0, y0, z0] = cell_of(point - Eigen::Vector3d::Constant(radius));
    const auto [x1, y1, z1] = cell_of(point + Eigen::Vector3d::Constant(radius));
    std::vector<std::size_t> numbers;
    for (std::int64_t x = x0; x <= x1; ++x) {
      for (std::int64_t y = y0; y <= y1; ++y) {
        for (auto it = cells_.lower_bound({x, y, z0}); it != cells_.end() && it->first <= Cell{x, y, z1};
             ++it)
          numbers.insert(numbers.end(), it->second.begin(), it->second.end());
      }
    }
    return numbers;
  }

 private:
  using Cell = std::tuple<std::int64_t, std::int64_t, std::int64_t>;
  static Cell cell_of(const Eigen::Vector3d& point) {
    constexpr double kSize = 0.5;  // metres
    const auto index = [](double value) { return static_cast<std::int64_t>(std::floor(value / kSize)); };
    return {index(point.x()), index(point.y()), index(point.z())};
  }

  std::map<Cell, std::vector<std::size_t>> cells_;
};

double total_std(const SurveyLandmark& landmark) {
  return std::sqrt(landmark.own_covariance().trace());
}

bool is_same_place(const SurveyLandmark& a, const SurveyLandmark& b, double sigmas) {
  const Eigen::Vector3d difference = a.point_in_world - b.point_in_world;
  const double reach = total_std(a) + total_std(b);
  if (difference.squaredNorm() > sigmas * sigmas * reach * reach) return false;
  const Eigen::Matrix3d covariance = a.own_covariance() + b.own_covariance();
  return difference.dot(covariance.inverse() * difference) <= sigmas * sigmas;
}

/// Returns the observations, one of each landmark, that are nearest in time.
std::pair<ObservationRef, ObservationRef> nearest_observations(const SurveyLandmark& a,
                                                               const SurveyLandmark& b) {
  std::pair<ObservationRef, ObservationRef> best{a.observations.front(), b.observations.front()};
  const auto gap = [](const ObservationRef& x, const ObservationRef& y) {
    return std::abs(x.keyframe.value - y.keyframe.value);
  };
  for (const ObservationRef& x : a.observations) {
    for (const ObservationRef& y : b.observations) {
      if (gap(x, y) < gap(best.first, best.second)) best = {x, y};
    }
  }
  return best;
}

Descriptors descriptor_of(const FrameBuffer& frames, const ObservationRef& observation) {
  const auto row = static_cast<std::size_t>(observation.feature);
  return select(frames[observation.keyframe].observed.features.descriptors, {&row, 1});
}

bool looks_the_same(const FrameBuffer& frames, const SurveyLandmark& a, const SurveyLandmark& b) {
  const auto [x, y] = nearest_observations(a, b);
  const Descriptors first = descriptor_of(frames, x);
  return !match_descriptors(first, descriptor_of(frames, y), {descriptor_limit(first), 0, false}).empty();
}

/// Returns the observations of both landmarks by frame; if both have one in a frame, that of `a`.
std::vector<ObservationRef> joined_observations(const SurveyLandmark& a, const SurveyLandmark& b) {
  const auto is_before = [](const ObservationRef& x, const ObservationRef& y) {
    return x.keyframe < y.keyframe;
  };
  std::vector<ObservationRef> joined;
  std::set_union(a.observations.begin(), a.observations.end(), b.observations.begin(), b.observations.end(),
                 std::back_inserter(joined), is_before);
  return joined;
}

/// Returns one landmark made of two, or nullopt if not nearly all observations agree or the landmark fails a
/// rule of cleaning, which the two may pass each.
std::optional<SurveyLandmark> joined(const MergeInput& input, const SurveyLandmark& a,
                                     const SurveyLandmark& b) {
  const auto& [rig, frames, prior, options] = input;
  constexpr double kMinKept = 0.9;
  const std::vector<ObservationRef> observations = joined_observations(a, b);
  if (static_cast<int>(observations.size()) >= options.tracks.max_frames) return std::nullopt;
  auto landmark = fit_observations(rig, frames, observations, options);
  if (!landmark || static_cast<double>(landmark->observations.size()) <
                       kMinKept * static_cast<double>(observations.size()))
    return std::nullopt;
  landmark->variance_factor = prior.factor(landmark->squared_error_sum, landmark->redundancy);
  if (failed_rule(landmark->indicators, landmark->own_covariance(), options.cleaning)) return std::nullopt;
  return landmark;
}

}  // namespace

std::int64_t merge_duplicates(const MergeInput& input, std::vector<SurveyLandmark>&& added,
                              std::vector<SurveyLandmark>& pending) {
  CellIndex index;
  double largest = 0;
  for (std::size_t i = 0; i < pending.size(); ++i) {
    index.add(pending[i].point_in_world, i);
    largest = std::max(largest, total_std(pending[i]));
  }
  const double sigmas = input.options.cleaning.duplicate_sigmas;
  std::int64_t merged = 0;
  for (SurveyLandmark& landmark : added) {
    const double reach = sigmas * (total_std(landmark) + largest);
    bool is_new = true;
    for (const std::size_t i : index.near(landmark.point_in_world, reach)) {
      if (!is_same_place(pending[i], landmark, sigmas) || !looks_the_same(input.frames, pending[i], landmark))
        continue;
      auto both = joined(input, pending[i], landmark);
      if (!both) continue;
      index.remove(pending[i].point_in_world, i);
      pending[i] = std::move(*both);
      index.add(pending[i].point_in_world, i);
      largest = std::max(largest, total_std(pending[i]));
      ++merged;
      is_new = false;
      break;
    }
    if (!is_new) continue;
    index.add(landmark.point_in_world, pending.size());
    largest = std::max(largest, total_std(landmark));
    pending.push_back(std::move(landmark));
  }
  return merged;
}

}  // namespace cairn
