// SPDX-License-Identifier: Apache-2.0
#include "cairn/features/kernels/corner_kernels.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "cairn/core/random.h"
#include "cairn/testing/features/each_instruction_set.h"
#include "cairn/testing/image/random_images.h"

namespace cairn {
namespace {

using testkit::blocky_image;
using testkit::EachInstructionSet;
using testkit::name_of_parameter;
using testkit::random_image;

/// The ring's differences to its centre, clockwise from the top, from its definition: the pixels between 2.5
/// and 3.5 from the centre, 16 of them.
std::vector<int> ring_differences(const GrayImage& image, int u, int v) {
  static const int kOffsets[16][2] = {{0, -3}, {1, -3},  {2, -2},  {3, -1}, {3, 0},  {3, 1},
                                      {2, 2},  {1, 3},   {0, 3},   {-1, 3}, {-2, 2}, {-3, 1},
                                      {-3, 0}, {-3, -1}, {-2, -2}, {-1, -3}};
  std::vector<int> differences;
  for (const auto& offset : kOffsets)
    differences.push_back(image(u + offset[0], v + offset[1]) - image(u, v));
  return differences;
}

bool is_corner(const std::vector<int>& ring, int threshold) {
  for (std::size_t first = 0; first < 16; ++first) {
    bool brighter = true, darker = true;
    for (std::size_t k = 0; k < 9; ++k) {
      brighter = brighter && ring[(first + k) % 16] > threshold;
      darker = darker && ring[(first + k) % 16] < -threshold;
    }
    if (brighter || darker) return true;
  }
  return false;
}

int slow_score(const GrayImage& image, int u, int v, int threshold) {
  const auto ring = ring_differences(image, u, v);
  int score = 0;
  for (int t = threshold; t <= 254 && is_corner(ring, t); ++t) score = t;
  return score;
}

using CornerKernelsTest = EachInstructionSet;

TEST_P(CornerKernelsTest, scores_are_the_highest_threshold_of_a_corner) {
  for (const auto& [width, height, seed] :
       {std::tuple{7, 7, 1}, {20, 9, 2}, {70, 12, 3}, {150, 11, 4}, {203, 8, 5}}) {
    const GrayImage image = blocky_image(width, height, static_cast<std::uint64_t>(seed));
    for (const int threshold : {1, 7, 20, 254}) {
      for (int v = 3; v < height - 3; ++v) {
        for (const int begin : {3, std::min(5, width - 4)}) {
          std::vector<std::uint8_t> scores(static_cast<std::size_t>(width), 77);
          const bool any =
              corner_kernels(GetParam())
                  .score_fast(image.row(v), width, width, begin, width - 3, threshold, scores.data());
          bool expected_any = false;
          for (int u = 0; u < width; ++u) {
            const bool inside = u >= begin && u < width - 3;
            const int expected = inside ? slow_score(image, u, v, threshold) : 77;
            ASSERT_EQ(scores[static_cast<std::size_t>(u)], expected) << u << ' ' << v << " of " << width;
            expected_any = expected_any || (inside && expected > 0);
          }
          ASSERT_EQ(any, expected_any);
        }
      }
    }
  }
}

TEST_P(CornerKernelsTest, peaks_are_above_earlier_and_not_below_later_neighbours) {
  constexpr int kWidth = 200, kHeight = 9, kReadAhead = 65;
  Random random(6);
  std::vector<std::uint8_t> scores(kWidth * kHeight + kReadAhead);
  for (auto& score : scores) score = static_cast<std::uint8_t>(random.index(4));
  for (int v = 1; v + 1 < kHeight; ++v) {
    const std::uint8_t* row = scores.data() + v * kWidth;
    std::vector<std::int32_t> found(kWidth), expected;
    const int count = corner_kernels(GetParam()).find_peaks(row, kWidth, 1, kWidth - 1, found.data());
    for (int u = 1; u < kWidth - 1; ++u) {
      bool peak = row[u] > 0;
      for (int k = 0; k < 9; ++k) {
        const int neighbour = row[u + (k / 3 - 1) * kWidth + k % 3 - 1];
        peak = peak && (k < 4 ? row[u] > neighbour : row[u] >= neighbour);
      }
      if (peak) expected.push_back(u);
    }
    found.resize(static_cast<std::size_t>(count));
    ASSERT_EQ(found, expected);
  }
}

TEST_P(CornerKernelsTest, structure_tensor_sums_sobel_derivatives) {
  const GrayImage image = random_image(40, 40, 7);
  for (int u = 5; u < 35; ++u) {
    std::int32_t expected[3]{}, sums[3]{};
    for (int y = 17; y <= 23; ++y) {
      for (int x = u - 3; x <= u + 3; ++x) {
        int dx = 0, dy = 0;
        for (int k = -1; k <= 1; ++k) {
          dx += (2 - std::abs(k)) * (image(x + 1, y + k) - image(x - 1, y + k));
          dy += (2 - std::abs(k)) * (image(x + k, y + 1) - image(x + k, y - 1));
        }
        expected[0] += dx * dx;
        expected[1] += dx * dy;
        expected[2] += dy * dy;
      }
    }
    corner_kernels(GetParam()).structure_tensor(image.row(20) + u, image.width(), sums);
    for (int k = 0; k < 3; ++k) ASSERT_EQ(sums[k], expected[k]);
  }
}

INSTANTIATE_TEST_SUITE_P(Sets, CornerKernelsTest, testing::ValuesIn(available_instruction_sets()),
                         name_of_parameter);

}  // namespace
}  // namespace cairn
