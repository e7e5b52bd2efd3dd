// SPDX-License-Identifier: Apache-2.0
#include "cairn/features/kernels/extrema_kernels.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "cairn/core/random.h"
#include "cairn/simd/available.h"

namespace cairn {
namespace {

constexpr int kWidth = 400;
constexpr std::size_t kMargin = 16;
constexpr float kThreshold = 3;

/// Four levels of three rows of few different values: ties are many.
struct Levels {
  explicit Levels(std::uint64_t seed) : pixels(std::size_t{12} * kWidth + 2 * kMargin) {
    Random random(seed);
    for (float& pixel : pixels) pixel = static_cast<float>(random.index(7));
    for (std::size_t i = 0; i < 12; ++i) rows.rows[i / 3][i % 3] = pixels.data() + kMargin + i * kWidth;
  }
  [[nodiscard]] float difference(int level, int row, int x) const {
    return rows.rows[level + 1][row][x] - rows.rows[level][row][x];
  }
  [[nodiscard]] bool is_extremum(int x) const {
    const float centre = difference(1, 1, x);
    bool largest = centre >= kThreshold, smallest = centre <= -kThreshold;
    for (int i = 0; i < 27; ++i) {
      const float neighbour = difference(i / 9, i / 3 % 3, x - 1 + i % 3);
      largest = largest && centre >= neighbour;
      smallest = smallest && centre <= neighbour;
    }
    return largest || smallest;
  }

  std::vector<float> pixels;
  GaussianRows rows{};
};

class ExtremaKernelsTest : public testing::TestWithParam<InstructionSet> {};

TEST_P(ExtremaKernelsTest, FindsWhatNoNeighbourExceeds) {
  std::size_t total = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Levels levels(seed);
    for (const auto& [begin, end] : {std::pair{1, 1}, {5, 6}, {3, 20}, {5, 380}, {16, 64}}) {
      std::vector<int> expected;
      for (int x = begin; x < end; ++x)
        if (levels.is_extremum(x)) expected.push_back(x);
      std::vector<int> found(static_cast<std::size_t>(end - begin));
      const int count = extrema_kernels(GetParam()).find(levels.rows, begin, end, kThreshold, found.data());
      found.resize(static_cast<std::size_t>(count));
      ASSERT_EQ(found, expected) << seed << ' ' << begin << ' ' << end;
      total += found.size();
    }
  }
  EXPECT_GT(total, 100U);
}

INSTANTIATE_TEST_SUITE_P(Sets, ExtremaKernelsTest, testing::ValuesIn(available_instruction_sets()),
                         [](const auto& set) { return "set" + std::to_string(static_cast<int>(set.param)); });

}  // namespace
}  // namespace cairn
