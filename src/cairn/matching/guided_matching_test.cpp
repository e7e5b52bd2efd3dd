// SPDX-License-Identifier: Apache-2.0
#include "cairn/matching/guided_matching.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "cairn/core/error.h"
#include "cairn/core/random.h"

namespace cairn {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Keypoints of one size at these pixels, all with the same descriptor.
Features features_at(const std::vector<Eigen::Vector2d>& pixels, Norm norm) {
  Features features;
  features.descriptors = Descriptors(norm, 32, pixels.size());
  for (const Eigen::Vector2d& pixel : pixels) {
    Keypoint keypoint;
    keypoint.u = static_cast<float>(pixel.x()), keypoint.v = static_cast<float>(pixel.y());
    keypoint.size = 20;
    features.keypoints.push_back(keypoint);
  }
  return features;
}

/// Random landmarks and keypoints with few different descriptors.
struct Predictions {
  std::vector<SearchWindow> places;
  Descriptors descriptors;
  Features features;

  Predictions(Norm norm, std::size_t landmarks, std::size_t keypoints, std::uint64_t seed)
      : descriptors(norm, 32, landmarks) {
    Random random(seed);
    for (std::size_t i = 0; i < landmarks; ++i) {
      places.push_back({random.uniform(0, 640), random.uniform(0, 480), random.uniform(0, 60), 15, 30});
      descriptors.row(i)[0] = static_cast<std::uint8_t>(random.index(8));
    }
    std::vector<Eigen::Vector2d> seen;
    for (std::size_t i = 0; i < keypoints; ++i)
      seen.emplace_back(random.uniform(0, 640), random.uniform(0, 480));
    features = features_at(seen, norm);
    for (std::size_t i = 0; i < keypoints; ++i) {
      features.keypoints[i].size = static_cast<float>(random.uniform(12, 33));
      features.descriptors.row(i)[0] = static_cast<std::uint8_t>(random.index(8));
    }
  }

  [[nodiscard]] bool may_match(std::size_t p, std::size_t k) const {
    const Keypoint& keypoint = features.keypoints[k];
    const double size = static_cast<double>(keypoint.size);
    return std::hypot(static_cast<double>(keypoint.u) - places[p].u,
                      static_cast<double>(keypoint.v) - places[p].v) <= places[p].radius_px &&
           size >= places[p].min_size && size <= places[p].max_size;
  }
  [[nodiscard]] double distance(std::size_t p, std::size_t k) const {
    const int a = descriptors.row(p)[0], b = features.descriptors.row(k)[0];
    return descriptors.norm() == Norm::l2 ? std::abs(a - b)
                                          : __builtin_popcount(static_cast<unsigned>(a ^ b));
  }
  /// Keypoints of landmark p, the nearest first.
  [[nodiscard]] std::vector<std::pair<double, std::size_t>> candidates(std::size_t p) const {
    std::vector<std::pair<double, std::size_t>> all;
    for (std::size_t k = 0; k < features.keypoints.size(); ++k)
      if (may_match(p, k)) all.emplace_back(distance(p, k), k);
    std::sort(all.begin(), all.end());
    return all;
  }
  [[nodiscard]] std::size_t nearest_landmark(std::size_t k) const {
    std::pair<double, std::size_t> best{kInfinity, 0};
    for (std::size_t p = 0; p < places.size(); ++p)
      if (may_match(p, k)) best = std::min(best, {distance(p, k), p});
    return best.second;
  }
  [[nodiscard]] std::vector<Match> slow_matches(const MatchOptions& options) const {
    std::vector<Match> matches;
    for (std::size_t p = 0; p < places.size(); ++p) {
      const auto all = candidates(p);
      if (all.empty() || all[0].first > options.max_distance) continue;
      if (options.max_ratio > 0 && all.size() > 1 && !(all[0].first < options.max_ratio * all[1].first))
        continue;
      if (options.mutual && nearest_landmark(all[0].second) != p) continue;
      matches.push_back({static_cast<std::int32_t>(p), static_cast<std::int32_t>(all[0].second),
                         static_cast<float>(all[0].first)});
    }
    return matches;
  }
};

TEST(MatchPredicted, agrees_with_the_definition) {
  std::size_t found = 0;
  for (const Norm norm : {Norm::hamming, Norm::l2}) {
    for (const auto& [landmarks, keypoints] :
         {std::pair(300, 500), std::pair(1, 1), std::pair(50, 1), std::pair(1, 900)}) {
      const Predictions predictions(norm, static_cast<std::size_t>(landmarks),
                                    static_cast<std::size_t>(keypoints), 3);
      for (const MatchOptions& options : {MatchOptions(), MatchOptions{kInfinity, 0, true},
                                          MatchOptions{1, 0, false}, MatchOptions{2, 0.7, true}}) {
        const auto expected = predictions.slow_matches(options);
        for (const int threads : {1, 3})
          EXPECT_EQ(match_predicted(predictions.places, predictions.descriptors, predictions.features,
                                    options, Executor(threads)),
                    expected);
        found += expected.size();
      }
    }
  }
  EXPECT_GT(found, 500U);
}

TEST(MatchPredicted, nothing_and_numbers_that_are_none_match_nothing) {
  Predictions predictions(Norm::hamming, 5, 20, 1);
  EXPECT_TRUE(match_predicted({}, Descriptors(), predictions.features, {}).empty());
  EXPECT_TRUE(match_predicted(predictions.places, predictions.descriptors, {}, {}).empty());
  for (SearchWindow& place : predictions.places) place.radius_px = kInfinity, place.min_size = 0;
  predictions.places[0].u = kNan, predictions.places[1].radius_px = kNan,
  predictions.places[2].max_size = kNan;
  predictions.features.keypoints[0].u = static_cast<float>(kNan);
  const auto matches = match_predicted(predictions.places, predictions.descriptors, predictions.features, {});
  ASSERT_EQ(matches.size(), 2U);
  EXPECT_EQ(matches[0].query, 3);
  for (const Match& match : matches) EXPECT_NE(match.train, 0);
}

TEST(MatchPredicted, refuses_what_has_no_meaning) {
  const Predictions predictions(Norm::hamming, 5, 20, 1), other(Norm::l2, 4, 20, 1);
  EXPECT_THROW((void)match_predicted(predictions.places, other.descriptors, predictions.features, {}),
               PreconditionError);
  EXPECT_THROW((void)match_predicted(other.places, other.descriptors, predictions.features, {}),
               PreconditionError);
  EXPECT_THROW((void)match_predicted(predictions.places, predictions.descriptors, predictions.features,
                                     {-1, 0, false}),
               PreconditionError);
}

}  // namespace
}  // namespace cairn
