// SPDX-License-Identifier: Apache-2.0
#include "cairn/matching/matching.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "cairn/core/random.h"

namespace cairn {
namespace {

Descriptors random_descriptors(Norm norm, std::size_t bytes, std::size_t count, std::uint64_t seed) {
  Random random(seed);
  Descriptors descriptors(norm, bytes, count);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t b = 0; b < bytes; ++b)
      descriptors.row(i)[b] = static_cast<std::uint8_t>(random.index(256));
  }
  return descriptors;
}

double slow_distance(const Descriptors& a, std::size_t i, const Descriptors& b, std::size_t j) {
  double sum = 0;
  for (std::size_t k = 0; k < a.bytes(); ++k) {
    const int x = a.row(i)[k], y = b.row(j)[k];
    sum += a.norm() == Norm::hamming ? std::popcount(static_cast<unsigned>(x ^ y)) : (x - y) * (x - y);
  }
  return a.norm() == Norm::hamming ? sum : std::sqrt(sum);
}

std::size_t slow_nearest(const Descriptors& a, std::size_t i, const Descriptors& b) {
  std::size_t best = 0;
  for (std::size_t j = 1; j < b.count(); ++j) {
    if (slow_distance(a, i, b, j) < slow_distance(a, i, b, best)) best = j;
  }
  return best;
}

/// Pairs with few different distances, so that most are tied.
Descriptors tied_descriptors(Norm norm, std::size_t bytes, std::size_t count, std::uint64_t seed) {
  Random random(seed);
  Descriptors descriptors(norm, bytes, count);
  for (std::size_t i = 0; i < count; ++i) descriptors.row(i)[0] = static_cast<std::uint8_t>(random.index(4));
  return descriptors;
}

std::vector<Match> slow_matches(const Descriptors& query, const Descriptors& train,
                                const MatchOptions& options) {
  std::vector<Match> matches;
  for (std::size_t q = 0; q < query.count(); ++q) {
    const std::size_t t = slow_nearest(query, q, train);
    double second = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < train.count(); ++j)
      if (j != t) second = std::min(second, slow_distance(query, q, train, j));
    const double first = slow_distance(query, q, train, t);
    if (options.mutual && slow_nearest(train, t, query) != q) continue;
    if (first > options.max_distance) continue;
    if (options.max_ratio > 0 && !(first < options.max_ratio * second)) continue;
    matches.push_back(
        {static_cast<std::int32_t>(q), static_cast<std::int32_t>(t), static_cast<float>(first)});
  }
  return matches;
}

struct Sides {
  Descriptors query, train;
};

/// Both norms, odd lengths, one and many on each side, distinct and tied.
std::vector<Sides> many_sides() {
  std::vector<Sides> sides;
  for (const Norm norm : {Norm::hamming, Norm::l2}) {
    for (const std::size_t bytes : {1UL, 32UL, 61UL, 128UL}) {
      for (const auto& [queries, trains] : {std::pair(60, 50), std::pair(1, 1), std::pair(1, 40),
                                            std::pair(40, 1), std::pair(13, 1100), std::pair(300, 17)}) {
        const auto q = static_cast<std::size_t>(queries), t = static_cast<std::size_t>(trains);
        sides.push_back({random_descriptors(norm, bytes, q, bytes), random_descriptors(norm, bytes, t, q)});
        sides.push_back({tied_descriptors(norm, bytes, q, bytes), tied_descriptors(norm, bytes, t, q)});
      }
    }
  }
  return sides;
}

std::vector<MatchOptions> many_options() {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return {{},
          {kInfinity, 0, true},
          {kInfinity, 0.8, false},
          {kInfinity, 0.95, true},
          {100, 0, false},
          {2, 0.9, true}};
}

TEST(MatchDescriptors, agrees_with_the_definition) {
  std::size_t found = 0;
  for (const auto& [query, train] : many_sides()) {
    for (const MatchOptions& options : many_options()) {
      const auto matches = match_descriptors(query, train, options);
      ASSERT_EQ(matches, slow_matches(query, train, options))
          << query.count() << 'x' << train.count() << " of " << query.bytes() << " bytes";
      found += matches.size();
    }
  }
  EXPECT_GT(found, 1000U);
}

TEST(MatchDescriptors, gives_the_same_on_any_number_of_threads) {
  const Descriptors query = tied_descriptors(Norm::l2, 128, 1001, 1),
                    train = tied_descriptors(Norm::l2, 128, 700, 2);
  for (const MatchOptions& options : many_options()) {
    const auto one = match_descriptors(query, train, options);
    for (const int threads : {2, 5})
      EXPECT_EQ(match_descriptors(query, train, options, Executor(threads)), one);
  }
}

TEST(MatchDescriptors, is_empty_where_a_side_is) {
  const Descriptors some = random_descriptors(Norm::l2, 128, 5, 1);
  for (const MatchOptions& options : many_options()) {
    EXPECT_TRUE(match_descriptors(some, Descriptors(), options).empty());
    EXPECT_TRUE(match_descriptors(Descriptors(), some, options).empty());
    EXPECT_TRUE(match_descriptors(Descriptors(), Descriptors(), options).empty());
  }
}

TEST(MatchDescriptors, refuses_different_kinds) {
  const Descriptors orb = random_descriptors(Norm::hamming, 32, 5, 1),
                    sift = random_descriptors(Norm::l2, 128, 5, 1),
                    long_orb = random_descriptors(Norm::hamming, 64, 5, 1);
  EXPECT_THROW((void)match_mutual(orb, sift), PreconditionError);
  EXPECT_THROW((void)match_mutual(orb, long_orb), PreconditionError);
}

TEST(MatchDescriptors, refuses_options_without_meaning) {
  const Descriptors some = random_descriptors(Norm::l2, 128, 5, 1);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const MatchOptions& options : {MatchOptions{-1, 0, false}, MatchOptions{nan, 0, false},
                                      MatchOptions{1, -0.5, false}, MatchOptions{1, nan, false}})
    EXPECT_THROW((void)match_descriptors(some, some, options), PreconditionError);
}

TEST(MatchTwoNearest, agrees_with_the_definition) {
  for (const auto& [query, train] : many_sides()) {
    const auto found = match_two_nearest(query, train);
    ASSERT_EQ(found.size(), query.count());
    for (std::size_t q = 0; q < query.count(); ++q) {
      std::vector<std::pair<double, std::int32_t>> all;
      for (std::size_t t = 0; t < train.count(); ++t)
        all.emplace_back(slow_distance(query, q, train, t), static_cast<std::int32_t>(t));
      all.emplace_back(std::numeric_limits<double>::infinity(), -1);
      std::sort(all.begin(), all.end());
      for (std::size_t k = 0; k < 2; ++k)
        ASSERT_EQ(found[q][k],
                  (Match{static_cast<std::int32_t>(q), all[k].second, static_cast<float>(all[k].first)}));
    }
  }
}

TEST(MatchMutual, is_the_same_seen_from_either_side) {
  const Descriptors a = random_descriptors(Norm::hamming, 32, 200, 1),
                    b = random_descriptors(Norm::hamming, 32, 150, 2);
  auto back = match_mutual(b, a);
  for (Match& match : back) std::swap(match.query, match.train);
  std::sort(back.begin(), back.end(), [](const Match& x, const Match& y) { return x.query < y.query; });
  EXPECT_EQ(match_mutual(a, b), back);
}

TEST(FilterByDistance, keeps_what_is_not_much_worse_than_the_best) {
  const std::vector<Match> matches{{0, 0, 20}, {1, 1, 39}, {2, 2, 40}, {3, 3, 41}};
  EXPECT_EQ(filter_by_distance(matches, 2.0, 10).size(), 3U);
  EXPECT_EQ(filter_by_distance(matches, 2.0, 20.5).size(), 4U);  // the floor
  EXPECT_EQ(filter_by_distance(matches, 1.0, 0).size(), 1U);
  EXPECT_TRUE(filter_by_distance({}, 2.0, 10).empty());
}

}  // namespace
}  // namespace cairn
