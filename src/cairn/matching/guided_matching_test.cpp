// SPDX-License-Identifier: Apache-2.0
#include "cairn/matching/guided_matching.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cairn/core/error.h"
#include "cairn/core/random.h"

namespace cairn {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Camera pinhole() {
  Camera camera;
  camera.width = 640, camera.height = 480;
  camera.fx = 500, camera.fy = 510, camera.cx = 318, camera.cy = 242;
  return camera;
}

/// The same descriptor for all, or one for each.
enum class Looks { alike, distinct };

Features features_at(const std::vector<Eigen::Vector2d>& places, Norm norm, Looks looks) {
  Features features;
  features.descriptors = Descriptors(norm, 32, places.size());
  Random random(11);
  for (std::size_t i = 0; i < places.size(); ++i) {
    Keypoint keypoint;
    keypoint.u = static_cast<float>(places[i].x()), keypoint.v = static_cast<float>(places[i].y());
    keypoint.size = 20;
    features.keypoints.push_back(keypoint);
    for (std::size_t b = 0; b < 32 && looks == Looks::distinct; ++b)
      features.descriptors.row(i)[b] = static_cast<std::uint8_t>(random.index(256));
  }
  return features;
}

/// Points seen by two cameras.
struct TwoViews {
  Camera query_camera = pinhole(), train_camera = pinhole();
  Rigid3 train_from_query;
  std::vector<Eigen::Vector2d> in_query, in_train;

  explicit TwoViews(const Eigen::Vector3d& translation, std::size_t count = 120) {
    train_camera.fx = 480, train_camera.cy = 250;
    train_from_query = {rotation_exp({0.03, -0.06, 0.1}), translation};
    Random random(5);
    while (in_query.size() < count) {
      const Eigen::Vector2d pixel(random.uniform(0, 639), random.uniform(0, 479));
      const auto point = query_camera.back_project(pixel, random.uniform(2, 9));
      const auto seen = train_camera.project(train_from_query * *point);
      if (!seen || !train_camera.contains(*seen)) continue;
      in_query.push_back(pixel);
      in_train.emplace_back(*seen + Eigen::Vector2d(random.uniform(-0.7, 0.7), random.uniform(-0.7, 0.7)));
    }
  }

  [[nodiscard]] std::vector<Match> match(const Features& query, const Features& train,
                                         const EpipolarMatchOptions& options, int threads = 1) const {
    return match_along_epipolar_lines({query_camera, query}, {train_camera, train}, train_from_query, options,
                                      Executor(threads));
  }

  /// Distance of train pixel t from the projections of query q's ray, by trying depths.
  [[nodiscard]] double slow_distance(std::size_t q, std::size_t t, double min_depth, double max_depth) const {
    constexpr int kSteps = 20000;
    const double low = 1 / max_depth, high = 1 / min_depth;
    double least = kInfinity;
    for (int i = 0; i <= kSteps; ++i) {
      const double depth = 1 / (low + (high - low) * i / kSteps);
      const auto point = query_camera.back_project(in_query[q], depth);
      const auto seen = train_camera.project(train_from_query * *point);
      if (seen) least = std::min(least, (*seen - in_train[t]).norm());
    }
    return least;
  }
};

TEST(MatchAlongEpipolarLines, finds_all_points_that_look_distinct) {
  for (const Eigen::Vector3d& translation : {Eigen::Vector3d(0.5, 0.1, 0), Eigen::Vector3d(0.05, 0, 0.6),
                                             Eigen::Vector3d(0, 0, -0.4), Eigen::Vector3d(0, 0, 0)}) {
    const TwoViews views(translation);
    for (const Norm norm : {Norm::hamming, Norm::l2}) {
      const Features query = features_at(views.in_query, norm, Looks::distinct),
                     train = features_at(views.in_train, norm, Looks::distinct);
      const auto matches = views.match(query, train, {});
      ASSERT_EQ(matches.size(), views.in_query.size());
      for (const Match& match : matches) EXPECT_EQ(match.query, match.train);
    }
  }
}

/// All look alike, so that the lowest candidate is taken, and all candidates are tested by it.
TEST(MatchAlongEpipolarLines, the_candidates_agree_with_trying_depths) {
  constexpr double kUnclear = 0.05;  // pixels around the band's edge, where the trial of depths may err
  EpipolarMatchOptions options;
  options.matching.mutual = false;
  options.min_depth = 1, options.max_depth = 20;
  for (const Eigen::Vector3d& translation :
       {Eigen::Vector3d(0.5, 0.1, 0), Eigen::Vector3d(0.05, 0, 0.6), Eigen::Vector3d(0, 0, 0)}) {
    const TwoViews views(translation, 40);
    const Features query = features_at(views.in_query, Norm::l2, Looks::alike),
                   train = features_at(views.in_train, Norm::l2, Looks::alike);
    const auto matches = views.match(query, train, options);
    std::size_t next = 0, checked = 0;
    for (std::size_t q = 0; q < views.in_query.size(); ++q) {
      std::int32_t expected = -1;
      bool clear = true;
      for (std::size_t t = 0; t < views.in_train.size() && expected < 0; ++t) {
        const double distance = views.slow_distance(q, t, options.min_depth, options.max_depth);
        clear = clear && std::abs(distance - options.band_px) > kUnclear;
        if (distance <= options.band_px) expected = static_cast<std::int32_t>(t);
      }
      const bool found = next < matches.size() && matches[next].query == static_cast<std::int32_t>(q);
      const std::int32_t train_index = found ? matches[next].train : -1;
      if (found) ++next;
      if (!clear) continue;
      ++checked;
      EXPECT_EQ(train_index, expected) << "query " << q;
    }
    EXPECT_EQ(next, matches.size());
    EXPECT_GT(checked, 30U);
  }
}

TEST(MatchAlongEpipolarLines, what_would_lie_behind_or_beyond_is_no_match) {
  TwoViews views({0.5, 0, 0}, 1);
  views.train_from_query.rotation.setIdentity();
  views.train_camera = views.query_camera;
  views.in_query = {{300, 200}};
  const auto found = [&](double u, const EpipolarMatchOptions& options) {
    const Features query = features_at(views.in_query, Norm::hamming, Looks::alike),
                   train = features_at({{u, 200}}, Norm::hamming, Looks::alike);
    return !views.match(query, train, options).empty();
  };
  // Depth z shows at 300 + 250 / z.
  EXPECT_TRUE(found(350, {}));    // 5 m
  EXPECT_TRUE(found(300, {}));    // infinitely far
  EXPECT_TRUE(found(298.5, {}));  // the same, within the band
  EXPECT_FALSE(found(290, {}));   // behind
  EpipolarMatchOptions options;
  options.min_depth = 4, options.max_depth = 10;
  EXPECT_TRUE(found(350, options));
  EXPECT_FALSE(found(370, options));
  EXPECT_FALSE(found(320, options));
}

TEST(MatchAlongEpipolarLines, limits_hold) {
  const TwoViews views({0.5, 0.1, 0}, 1);
  const Features query = features_at(views.in_query, Norm::hamming, Looks::alike);
  Features train = features_at(views.in_train, Norm::hamming, Looks::alike);
  train.descriptors.row(0)[5] = 7;
  EpipolarMatchOptions options;
  options.matching.max_distance = 3;
  EXPECT_EQ(views.match(query, train, options).size(), 1U);
  options.matching.max_distance = 2;
  EXPECT_TRUE(views.match(query, train, options).empty());
  train.keypoints[0].size = 41;
  EXPECT_TRUE(views.match(query, train, {}).empty());
}

TEST(MatchAlongEpipolarLines, gives_the_same_on_any_number_of_threads) {
  const TwoViews views({0.3, 0, 0.2}, 300);
  const Features query = features_at(views.in_query, Norm::l2, Looks::alike),
                 train = features_at(views.in_train, Norm::l2, Looks::alike);
  for (const bool mutual : {false, true}) {
    EpipolarMatchOptions options;
    options.matching.mutual = mutual;
    const auto one = views.match(query, train, options);
    EXPECT_FALSE(one.empty());
    EXPECT_EQ(views.match(query, train, options, 2), one);
    EXPECT_EQ(views.match(query, train, options, 5), one);
  }
}

TEST(MatchAlongEpipolarLines, nothing_and_numbers_that_are_none_match_nothing) {
  const TwoViews views({0.5, 0.1, 0}, 10);
  Features query = features_at(views.in_query, Norm::hamming, Looks::distinct),
           train = features_at(views.in_train, Norm::hamming, Looks::distinct);
  EXPECT_TRUE(views.match({}, train, {}).empty());
  EXPECT_TRUE(views.match(query, {}, {}).empty());
  query.keypoints[0].u = static_cast<float>(kNan), query.keypoints[1].v = static_cast<float>(kInfinity);
  train.keypoints[2].v = static_cast<float>(kNan), train.keypoints[3].sigma_px = static_cast<float>(kNan);
  const auto matches = views.match(query, train, {});
  ASSERT_EQ(matches.size(), 6U);
  EXPECT_EQ(matches.front().query, 4);
}

TEST(MatchAlongEpipolarLines, refuses_what_has_no_meaning) {
  TwoViews views({0.5, 0.1, 0}, 3);
  const Features query = features_at(views.in_query, Norm::hamming, Looks::distinct),
                 other = features_at(views.in_train, Norm::l2, Looks::distinct);
  EXPECT_THROW((void)views.match(query, other, {}), PreconditionError);
  EpipolarMatchOptions options;
  options.band_px = kNan;
  EXPECT_THROW((void)views.match(query, query, options), PreconditionError);
  views.train_camera.model = CameraModel::radtan;
  EXPECT_THROW((void)views.match(query, query, {}), PreconditionError);
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
    features = features_at(seen, norm, Looks::alike);
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
