// SPDX-License-Identifier: Apache-2.0
#include "cairn/features/matching.h"

#include <gtest/gtest.h>

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

TEST(MatchMutual, agrees_with_the_definition) {
  for (const Norm norm : {Norm::hamming, Norm::l2}) {
    for (const std::size_t bytes : {32UL, 61UL, 128UL}) {
      const Descriptors a = random_descriptors(norm, bytes, 60, bytes),
                        b = random_descriptors(norm, bytes, 50, bytes + 1);
      const auto matches = match_mutual(a, b);
      std::size_t next = 0;
      for (std::size_t q = 0; q < a.count(); ++q) {
        const std::size_t t = slow_nearest(a, q, b);
        if (slow_nearest(b, t, a) != q) continue;
        ASSERT_LT(next, matches.size());
        EXPECT_EQ(matches[next].query, static_cast<std::int32_t>(q));
        EXPECT_EQ(matches[next].train, static_cast<std::int32_t>(t));
        EXPECT_FLOAT_EQ(matches[next].distance, static_cast<float>(slow_distance(a, q, b, t)));
        ++next;
      }
      EXPECT_EQ(next, matches.size());
    }
  }
}

TEST(MatchMutual, is_empty_where_a_side_is) {
  const Descriptors some = random_descriptors(Norm::hamming, 32, 5, 1);
  EXPECT_TRUE(match_mutual(some, Descriptors()).empty());
  EXPECT_TRUE(match_mutual(Descriptors(), some).empty());
}

TEST(MatchMutual, refuses_different_kinds) {
  const Descriptors orb = random_descriptors(Norm::hamming, 32, 5, 1),
                    sift = random_descriptors(Norm::l2, 128, 5, 1);
  EXPECT_THROW((void)match_mutual(orb, sift), PreconditionError);
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
