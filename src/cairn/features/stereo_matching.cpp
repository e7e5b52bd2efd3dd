// SPDX-License-Identifier: Apache-2.0
#include "cairn/features/stereo_matching.h"

#include <algorithm>
#include <cmath>

#include "cairn/core/error.h"
#include "cairn/features/kernels/nearest_kernels.h"
#include "cairn/features/packed_descriptors.h"
#include "cairn/features/stereo_disparity.h"

namespace cairn {
namespace {

bool is_usable(const Keypoint& keypoint) {
  return std::isfinite(keypoint.u) && std::isfinite(keypoint.v) && std::isfinite(keypoint.size) &&
         std::isfinite(keypoint.sigma_px) && keypoint.sigma_px > 0;
}

/// Indices of the usable keypoints, from the top of the image down.
std::vector<std::int32_t> by_row(const std::vector<Keypoint>& keypoints) {
  std::vector<std::int32_t> order;
  for (std::size_t i = 0; i < keypoints.size(); ++i)
    if (is_usable(keypoints[i])) order.push_back(static_cast<std::int32_t>(i));
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
  explicit Rows(const std::vector<Keypoint>& keypoints) : order(by_row(keypoints)) {
    for (const std::int32_t i : order) {
      const Keypoint& keypoint = keypoints[static_cast<std::size_t>(i)];
      u.push_back(keypoint.u), v.push_back(keypoint.v);
      size.push_back(keypoint.size), sigma.push_back(keypoint.sigma_px);
      max_sigma = std::max(max_sigma, keypoint.sigma_px);
    }
  }

  std::vector<std::int32_t> order;
  std::vector<float> u, v, size, sigma;
  float max_sigma = 0;
};

struct Range {
  double low = 0, high = 0;
  [[nodiscard]] bool contains(double x) const { return x >= low && x <= high; }
};

/// The nearest of some candidates that come in any order, and the distance of the second nearest.
struct Best {
  std::int32_t distance = kNoDistance, index = -1, second_distance = kNoDistance;

  void see(std::int32_t seen_distance, std::int32_t seen_index) {
    if (seen_distance < distance || (seen_distance == distance && seen_index < index)) {
      second_distance = distance;
      distance = seen_distance, index = seen_index;
    } else {
      second_distance = std::min(second_distance, seen_distance);
    }
  }
};

class StereoSearch {
 public:
  StereoSearch(const Rig& rig, const Features& left, const Features& right, const StereoMatchOptions& options)
      : left_(left),
        right_(right),
        row_band_(static_cast<float>(options.row_band)),
        max_size_ratio_(static_cast<float>(options.max_size_ratio)),
        min_disparity_(static_cast<float>(rig.disparity(options.max_depth))),
        max_disparity_(static_cast<float>(rig.disparity(options.min_depth))),
        rows_(right.keypoints),
        packed_(right.descriptors, rows_.order) {}

  /// For each left feature the best right one, which has it as its best; index -1 where there is none.
  [[nodiscard]] std::vector<Best> run(const Executor& executor) const {
    constexpr std::size_t kGrain = 128;
    const std::size_t blocks = (left_.keypoints.size() + kGrain - 1) / kGrain;
    std::vector<Best> of_left(left_.keypoints.size());
    auto of_right = executor.map<std::vector<Best>>(blocks, [&](std::size_t block) {
      return search_block(block * kGrain, std::min(of_left.size(), (block + 1) * kGrain), of_left);
    });
    for (std::size_t block = 1; block < blocks; ++block)
      for (std::size_t r = 0; r < of_right[0].size(); ++r)
        if (of_right[block][r].index >= 0)
          of_right[0][r].see(of_right[block][r].distance, of_right[block][r].index);
    for (std::size_t l = 0; l < of_left.size(); ++l)
      if (of_left[l].index >= 0 &&
          of_right[0][static_cast<std::size_t>(of_left[l].index)].index != static_cast<std::int32_t>(l))
        of_left[l].index = -1;
    return of_left;
  }

 private:
  /// Writes the best of left features [begin, end) and returns, of each right one, the best among those.
  [[nodiscard]] std::vector<Best> search_block(std::size_t begin, std::size_t end,
                                               std::vector<Best>& of_left) const {
    std::vector<Best> of_right(right_.keypoints.size());
    Scratch scratch{std::vector<std::int32_t>(packed_.groups() * kPackedLanes),
                    std::vector<std::uint32_t>(rows_.order.size()),
                    std::vector<std::uint32_t>(rows_.order.size())};
    for (std::size_t l = begin; l < end; ++l)
      if (is_usable(left_.keypoints[l])) search_band(l, of_left[l], of_right, scratch);
    return of_right;
  }

  /// Of one block, which is worked on by one thread.
  struct Scratch {
    std::vector<std::int32_t> distances;
    std::vector<std::uint32_t> may_match, places;
  };

  void search_band(std::size_t l, Best& best, std::vector<Best>& of_right, Scratch& scratch) const {
    const Keypoint& keypoint = left_.keypoints[l];
    const float reach = row_band_ * std::max(keypoint.sigma_px, rows_.max_sigma);
    const auto from = std::lower_bound(rows_.v.begin(), rows_.v.end(), keypoint.v - reach);
    const auto to = std::upper_bound(from, rows_.v.end(), keypoint.v + reach);
    if (from == to) return;
    const auto first = static_cast<std::size_t>(from - rows_.v.begin());
    const auto last = static_cast<std::size_t>(to - rows_.v.begin());
    const std::size_t group = first / kPackedLanes, end_group = (last + kPackedLanes - 1) / kPackedLanes;
    packed_.measure(left_.descriptors, l, 1, group, end_group - group, scratch.distances.data());
    const std::size_t count = select(keypoint, first, last, scratch);
    for (std::size_t i = 0; i < count; ++i) {
      const std::int32_t distance = scratch.distances[scratch.places[i] - group * kPackedLanes];
      const std::int32_t r = rows_.order[scratch.places[i]];
      best.see(distance, r);
      of_right[static_cast<std::size_t>(r)].see(distance, static_cast<std::int32_t>(l));
    }
  }

  /// Writes the places in [first, last) that may match, and returns how many. Two plain loops, of which the
  /// first works on several places at once and the second has no branch: whether a place may match cannot be
  /// predicted.
  std::size_t select(const Keypoint& left, std::size_t first, std::size_t last, Scratch& scratch) const {
    const std::size_t count = last - first;
    const float* u = rows_.u.data() + first;
    const float* v = rows_.v.data() + first;
    const float* size = rows_.size.data() + first;
    const float* sigma = rows_.sigma.data() + first;
    std::uint32_t* may_match = scratch.may_match.data();
    for (std::size_t i = 0; i < count; ++i) {
      const float reach = row_band_ * (sigma[i] > left.sigma_px ? sigma[i] : left.sigma_px);
      const float disparity = left.u - u[i], rows = std::abs(left.v - v[i]);
      const std::uint32_t near_row = rows <= reach ? 1 : 0;
      const std::uint32_t in_range = static_cast<std::uint32_t>(disparity >= min_disparity_ - reach ? 1 : 0) &
                                     static_cast<std::uint32_t>(disparity <= max_disparity_ + reach ? 1 : 0);
      const std::uint32_t alike = static_cast<std::uint32_t>(size[i] <= max_size_ratio_ * left.size ? 1 : 0) &
                                  static_cast<std::uint32_t>(left.size <= max_size_ratio_ * size[i] ? 1 : 0);
      may_match[i] = near_row & in_range & alike;
    }
    std::size_t selected = 0;
    for (std::size_t i = 0; i < count; ++i) {
      scratch.places[selected] = static_cast<std::uint32_t>(first + i);
      selected += may_match[i];
    }
    return selected;
  }

  const Features& left_;
  const Features& right_;
  float row_band_, max_size_ratio_, min_disparity_, max_disparity_;
  Rows rows_;
  PackedDescriptors packed_;
};

bool is_believed(Norm norm, const Best& best, const StereoMatchOptions& options) {
  const auto first = static_cast<double>(match_distance(norm, best.distance));
  const auto second = best.second_distance == kNoDistance
                          ? std::numeric_limits<double>::infinity()
                          : static_cast<double>(match_distance(norm, best.second_distance));
  return first <= options.max_distance && (options.max_ratio == 0 || first < options.max_ratio * second);
}

/// Nothing where the images contradict the match.
std::optional<StereoMatch> measure(const StereoSide& left, const StereoSide& right, const Keypoint& a,
                                   const Keypoint& b, const StereoMatchOptions& options) {
  StereoMatch match;
  match.disparity = static_cast<double>(a.u - b.u);
  match.sigma_disparity_px = std::hypot(static_cast<double>(a.sigma_px), static_cast<double>(b.sigma_px));
  const double reach = static_cast<double>(std::max(a.sigma_px, b.sigma_px));
  const DisparityResult result = measure_disparity(left.image, right.image, static_cast<double>(a.u),
                                                   static_cast<double>(a.v), match.disparity, reach);
  if (result.status == DisparityStatus::not_settled) return std::nullopt;
  if (result.status != DisparityStatus::measured) return match;
  if (result.measured.sigma_px > match.sigma_disparity_px) return match;
  if (result.measured.correlation < options.min_correlation) return std::nullopt;
  match.disparity = result.measured.disparity;
  match.sigma_disparity_px = result.measured.sigma_px;
  match.measured = true;
  return match;
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
  if (left.features.keypoints.empty() || right.features.keypoints.empty()) return matches;
  require_comparable(left.features.descriptors, right.features.descriptors);
  const std::vector<Best> found = StereoSearch(rig, left.features, right.features, options).run(executor);
  // A disparity of less has no meaning, and its depth might not be a number.
  constexpr double kMinDisparity = 0.01;
  const Range allowed{std::max(kMinDisparity, rig.disparity(options.max_depth)),
                      rig.disparity(options.min_depth)};
  constexpr std::size_t kGrain = 32;
  executor.for_each_chunk(found.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t l = begin; l < end; ++l) {
      if (found[l].index < 0 || !is_believed(left.features.descriptors.norm(), found[l], options)) continue;
      const Keypoint& a = left.features.keypoints[l];
      const Keypoint& b = right.features.keypoints[static_cast<std::size_t>(found[l].index)];
      auto match = measure(left, right, a, b, options);
      if (!match || !allowed.contains(match->disparity)) continue;
      match->right = found[l].index;
      match->distance = match_distance(left.features.descriptors.norm(), found[l].distance);
      matches[l] = match;
    }
  });
  return matches;
}

}  // namespace cairn
