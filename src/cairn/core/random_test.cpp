// SPDX-License-Identifier: Apache-2.0
#include "cairn/core/random.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>

#include "cairn/core/error.h"

namespace cairn {
namespace {

constexpr int kDraws = 100'000;

/// Pinned: a change of these values changes every result that used a random number.
TEST(Random, gives_the_same_numbers_as_ever) {
  Random random(1, 2);
  EXPECT_EQ(random.next(), 0x0e17b859d95c24efULL);
  EXPECT_EQ(random.next(), 0x1111270bc6698f5eULL);
  EXPECT_EQ(Random(0).next(), 0xe220a8397b1dcdafULL);
}

TEST(Random, depends_on_seed_and_stream) {
  std::set<std::uint64_t> first;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    for (std::uint64_t stream = 0; stream < 100; ++stream) first.insert(Random(seed, stream).next());
  }
  EXPECT_EQ(first.size(), 10'000U);
}

TEST(Random, uniform_fills_its_range_evenly) {
  Random random(3);
  std::array<int, 10> bins{};
  for (int i = 0; i < kDraws; ++i) {
    const double value = random.uniform();
    ASSERT_GE(value, 0.0);
    ASSERT_LT(value, 1.0);
    ++bins.at(static_cast<std::size_t>(10 * value));
  }
  double chi_square = 0;
  for (const int count : bins) chi_square += std::pow(count - kDraws / 10.0, 2) / (kDraws / 10.0);
  EXPECT_LT(chi_square, 27.9);  // 9 degrees of freedom, exceeded with probability 0.001
}

TEST(Random, uniform_keeps_to_the_bounds_given) {
  Random random(4);
  double sum = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double value = random.uniform(-2.0, 6.0);
    ASSERT_GE(value, -2.0);
    ASSERT_LT(value, 6.0);
    sum += value;
  }
  EXPECT_NEAR(sum / kDraws, 2.0, 4.0 * 8.0 / std::sqrt(12.0 * kDraws));
}

TEST(Random, normal_has_the_moments_of_a_standard_normal) {
  Random random(5);
  double sum = 0, squares = 0, fourths = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double value = random.normal();
    sum += value;
    squares += value * value;
    fourths += value * value * value * value;
  }
  EXPECT_NEAR(sum / kDraws, 0.0, 4.0 / std::sqrt(kDraws));
  EXPECT_NEAR(squares / kDraws, 1.0, 4.0 * std::sqrt(2.0 / kDraws));
  EXPECT_NEAR(fourths / kDraws, 3.0, 4.0 * std::sqrt(96.0 / kDraws));
}

TEST(Random, index_reaches_each_place_about_equally_often) {
  Random random(6);
  std::array<int, 7> bins{};
  for (int i = 0; i < kDraws; ++i) ++bins.at(random.index(7));
  for (const int count : bins) EXPECT_NEAR(count, kDraws / 7.0, 5.0 * std::sqrt(kDraws / 7.0));
  EXPECT_EQ(random.index(1), 0U);
  EXPECT_THROW((void)random.index(0), PreconditionError);
}

/// Streams side by side, as items of a loop use them, are not correlated.
TEST(Random, neighbouring_streams_are_independent) {
  double product = 0;
  for (std::uint64_t i = 0; i < kDraws; ++i) {
    product += (Random(1, i).uniform() - 0.5) * (Random(1, i + 1).uniform() - 0.5);
  }
  EXPECT_NEAR(product / kDraws, 0.0, 4.0 / 12.0 / std::sqrt(kDraws));
}

}  // namespace
}  // namespace cairn
