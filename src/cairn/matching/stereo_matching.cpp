// SPDX-License-Identifier: Apache-2.0
#include "cairn/matching/stereo_matching.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cairn/core/error.h"
#include "cairn/matching/matching_candidates.h"
#include "cairn/matching/packed_descriptors.h"
#include "cairn/matching/stereo_disparity.h"

namespace cairn {
namespace {

/// Has finite numbers and lies in the image.
bool is_usable(const Keypoint& keypoint, int height) {
  return std::isfinite(keypoint.u) && std::isfinite(keypoint.size) && std::isfinite(keypoint.sigma_px) &&
         keypoint.sigma_px > 0 && keypoint.v >= -0.5F && keypoint.v < static_cast<float>(height) - 0.5F;
}

/// Indices of the usable keypoints, from the top of the image down.
std::vector<std::int32_t> by_row(const std::vector<Keypoint>& keypoints, int height) {
  std::vector<std::int32_t> order;
  for (std::size_t i = 0; i < keypoints.size(); ++i)
    if (is_usable(keypoints[i], height)) order.push_back(static_cast<std::int32_t>(i));
  std::sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
    const float row_a = keypoints[static_cast<std::size_t>(a)].v,
                row_b = keypoints[static_cast<std::size_t>(b)].v;
    return row_a != row_b ? row_a < row_b : a < b;
  });
  return order;
}

/// Right keypoints from the top of the image down, each quantity by itself: most are looked at only to be
/// passed over.
struct Rows {
  Rows(const std::vector<Keypoint>& keypoints, int height) : order(by_row(keypoints, height)) {
    for (const std::int32_t i : order) {
      const Keypoint& keypoint = keypoints[static_cast<std::size_t>(i)];
      u.push_back(keypoint.u), v.push_back(keypoint.v);
      size.push_back(keypoint.size), sigma.push_back(keypoint.sigma_px);
    }
    for (int row = 0; row <= height; ++row)
      begins.push_back(static_cast<std::size_t>(
          std::lower_bound(v.begin(), v.end(), static_cast<float>(row)) - v.begin()));
    begins.front() = 0;  // half a pixel above the first row is in the image
    rank_by_size();
  }

  /// The largest sigma of the keypoints up to this size; 0 where there is none.
  [[nodiscard]] float max_sigma_up_to(float largest_size) const {
    const auto end = std::upper_bound(sizes_.begin(), sizes_.end(), largest_size);
    return end == sizes_.begin() ? 0 : max_sigmas_[static_cast<std::size_t>(end - sizes_.begin()) - 1];
  }

  /// Begin and end of the places that hold all keypoints between two heights, and few others.
  [[nodiscard]] std::pair<std::size_t, std::size_t> between(float top, float bottom) const {
    const auto last = static_cast<float>(begins.size() - 1);
    const auto first_row = static_cast<std::size_t>(std::clamp(std::floor(top), 0.F, last));
    const auto end_row = static_cast<std::size_t>(std::clamp(std::floor(bottom) + 1, 0.F, last));
    return {begins[first_row], begins[end_row]};
  }

  std::vector<std::int32_t> order;
  std::vector<float> u, v, size, sigma;
  std::vector<std::size_t> begins;  // of the keypoints at or below each row

 private:
  void rank_by_size() {
    std::vector<std::pair<float, float>> ranked;
    for (std::size_t i = 0; i < size.size(); ++i) ranked.emplace_back(size[i], sigma[i]);
    std::sort(ranked.begin(), ranked.end());
    float largest = 0;
    for (const auto& [size_px, sigma_px] : ranked) {
      largest = std::max(largest, sigma_px);
      sizes_.push_back(size_px), max_sigmas_.push_back(largest);
    }
  }

  std::vector<float> sizes_, max_sigmas_;  // ascending, and the largest sigma up to each
};

/// Finds the right features that a left one may match.
class StereoSearch {
 public:
  StereoSearch(const Rig& rig, const StereoSide& left, const StereoSide& right,
               const StereoMatchOptions& options)
      : left_(left.features),
        height_(left.image.height()),
        row_band_(static_cast<float>(options.row_band)),
        max_size_ratio_(static_cast<float>(options.max_size_ratio)),
        min_disparity_(static_cast<float>(rig.disparity(options.max_depth))),
        max_disparity_(static_cast<float>(rig.disparity(options.min_depth))),
        rows_(right.features.keypoints, height_),
        packed_(right.features.descriptors, rows_.order) {}

  /// The right features that left feature l may match.
  void find(std::size_t l, Candidates& candidates) const {
    const Keypoint& keypoint = left_.keypoints[l];
    if (!is_usable(keypoint, height_)) return;
    // What is much larger cannot match, and would widen the band for all.
    const float reach =
        row_band_ * std::max(keypoint.sigma_px, rows_.max_sigma_up_to(max_size_ratio_ * keypoint.size));
    const auto [first, last] = rows_.between(keypoint.v - reach, keypoint.v + reach);
    if (first == last) return;
    const std::size_t group = first / kPackedLanes, end_group = (last + kPackedLanes - 1) / kPackedLanes;
    candidates.tile.resize((end_group - group) * kPackedLanes);
    packed_.measure(left_.descriptors, l, 1, group, end_group - group, candidates.tile.data());
    candidates.flags.resize(last - first);
    flag(keypoint, first, candidates.flags);
    pick(first, first - group * kPackedLanes, candidates);
  }

 private:
  /// flags[i] = 1 where place first + i may match. A plain loop that works on several places at once.
  void flag(const Keypoint& left, std::size_t first, std::vector<std::uint32_t>& flags) const {
    const float* u = rows_.u.data() + first;
    const float* v = rows_.v.data() + first;
    const float* size = rows_.size.data() + first;
    const float* sigma = rows_.sigma.data() + first;
    std::uint32_t* flag = flags.data();
    for (std::size_t i = 0; i < flags.size(); ++i) {
      const float reach = row_band_ * (sigma[i] > left.sigma_px ? sigma[i] : left.sigma_px);
      const float disparity = left.u - u[i];
      const bool near_row = std::abs(left.v - v[i]) <= reach;
      const bool in_range = (disparity >= min_disparity_ - reach) & (disparity <= max_disparity_ + reach);
      const bool alike = (size[i] <= max_size_ratio_ * left.size) & (left.size <= max_size_ratio_ * size[i]);
      flag[i] = (near_row & in_range & alike) ? 1 : 0;
    }
  }

  /// Those flagged, without a branch: whether a place may match cannot be predicted.
  void pick(std::size_t first, std::size_t first_in_tile, Candidates& candidates) const {
    const std::size_t count = candidates.flags.size();
    candidates.trains.resize(count);
    candidates.distances.resize(count);
    std::size_t picked = 0;
    for (std::size_t i = 0; i < count; ++i) {
      candidates.trains[picked] = rows_.order[first + i];
      candidates.distances[picked] = candidates.tile[first_in_tile + i];
      picked += candidates.flags[i];
    }
    candidates.trains.resize(picked);
    candidates.distances.resize(picked);
  }

  const Features& left_;
  int height_;
  float row_band_, max_size_ratio_, min_disparity_, max_disparity_;
  Rows rows_;
  PackedDescriptors packed_;
};

bool is_in_range(const Rig& rig, const StereoMatchOptions& options, double disparity) {
  constexpr double kMinDisparity = 0.01;  // pixels; of less the depth means nothing and might not be a number
  return disparity >= std::max(kMinDisparity, rig.disparity(options.max_depth)) &&
         disparity <= rig.disparity(options.min_depth);
}

/// Nothing where the images contradict the match.
std::optional<StereoMatch> measure(const StereoSide& left, const StereoSide& right, const Match& found,
                                   double min_correlation) {
  const Keypoint& a = left.features.keypoints[static_cast<std::size_t>(found.query)];
  const Keypoint& b = right.features.keypoints[static_cast<std::size_t>(found.train)];
  const auto u = static_cast<double>(a.u), v = static_cast<double>(a.v);
  const auto sigma_a = static_cast<double>(a.sigma_px), sigma_b = static_cast<double>(b.sigma_px);
  StereoMatch match{found.train, found.distance, u - static_cast<double>(b.u), std::hypot(sigma_a, sigma_b),
                    false};
  const DisparityResult result =
      measure_disparity(left.image, right.image, u, v, match.disparity, std::max(sigma_a, sigma_b));
  if (result.status == DisparityStatus::not_settled) return std::nullopt;
  if (result.status != DisparityStatus::measured || result.measured.sigma_px > match.sigma_disparity_px)
    return match;
  if (result.measured.correlation < min_correlation) return std::nullopt;
  match.disparity = result.measured.disparity;
  match.sigma_disparity_px = result.measured.sigma_px;
  match.measured = true;
  return match;
}

/// A feature without a right one, by its window alone.
std::optional<StereoMatch> find_in_image(const Rig& rig, const StereoSide& left, const GrayImage& right,
                                         const Keypoint& keypoint, const StereoMatchOptions& options) {
  if (!is_usable(keypoint, left.image.height())) return std::nullopt;
  const auto u = static_cast<double>(keypoint.u), v = static_cast<double>(keypoint.v);
  const auto first = static_cast<int>(rig.disparity(options.max_depth));
  const auto last = static_cast<int>(std::min<double>(rig.disparity(options.min_depth), right.width())) + 1;
  const auto found = find_disparity(left.image, right, u, v, first, last);
  if (!found) return std::nullopt;
  const DisparityResult result = measure_disparity(left.image, right, u, v, *found, 1);
  if (result.status != DisparityStatus::measured || result.measured.correlation < options.min_correlation)
    return std::nullopt;
  return StereoMatch{-1, std::numeric_limits<float>::infinity(), result.measured.disparity,
                     result.measured.sigma_px, true};
}

/// For each left feature its right one by the descriptors.
std::vector<std::optional<Match>> find_features(const Rig& rig, const StereoSide& left,
                                                const StereoSide& right, const StereoMatchOptions& options,
                                                const Executor& executor) {
  const std::size_t lefts = left.features.keypoints.size(), rights = right.features.keypoints.size();
  if (rights == 0) return std::vector<std::optional<Match>>(lefts);
  require_comparable(left.features.descriptors, right.features.descriptors);
  const StereoSearch search(rig, left, right, options);
  const MatchOptions limits{options.max_distance, options.max_ratio, true};
  return match_candidates(
      lefts, rights, left.features.descriptors.norm(),
      [&](std::size_t l, Candidates& candidates) { search.find(l, candidates); }, limits, executor);
}

}  // namespace

void StereoMatchOptions::validate() const {
  require(min_depth > 0 && max_depth > min_depth, "the depth limits are above 0 and ascend");
  require(row_band >= 0 && std::isfinite(row_band), "the row band is not negative");
  require(max_size_ratio >= 1, "sizes may be equal");
  require(max_distance >= 0 && max_ratio >= 0, "distance limit and ratio are not negative");
  require(min_correlation <= 1, "windows correlate by at most 1");
}

std::vector<std::optional<StereoMatch>> match_stereo(const Rig& rig, const StereoSide& left,
                                                     const StereoSide& right,
                                                     const StereoMatchOptions& options,
                                                     const Executor& executor) {
  options.validate();
  require(rig.fx > 0 && rig.baseline > 0, "the rig has a focal length and a baseline");
  require(left.image.width() == right.image.width() && left.image.height() == right.image.height(),
          "both images have one size");
  std::vector<std::optional<StereoMatch>> matches(left.features.keypoints.size());
  if (matches.empty()) return matches;
  const auto found = find_features(rig, left, right, options, executor);
  constexpr std::size_t kGrain = 32;
  executor.for_each_chunk(found.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t l = begin; l < end; ++l) {
      if (found[l]) matches[l] = measure(left, right, *found[l], options.min_correlation);
      if (!matches[l] && options.search_images)
        matches[l] = find_in_image(rig, left, right.image, left.features.keypoints[l], options);
      if (matches[l] && !is_in_range(rig, options, matches[l]->disparity)) matches[l].reset();
    }
  });
  return matches;
}

}  // namespace cairn
