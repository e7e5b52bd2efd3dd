// SPDX-License-Identifier: Apache-2.0
#include "cairn/features/kernels/blur_kernels.h"

#include <gtest/gtest.h>

#include "cairn/core/random.h"
#include "cairn/simd/available.h"

namespace cairn {
namespace {

constexpr int kMargin = 16;

std::vector<float> random_floats(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<float> values(count);
  for (float& value : values) value = static_cast<float>(random.uniform(0, 255));
  return values;
}

class BlurKernelsTest : public testing::TestWithParam<InstructionSet> {};

TEST_P(BlurKernelsTest, SumRowsIsTheWeightedSumBitForBit) {
  constexpr int kPairs = 4;
  const std::vector<float> weights{0.1F, 0.2F, 0.15F, 0.05F};
  for (const int count : {16, 48, 64, 208}) {
    for (const int shift : {0, 1}) {
      const std::vector<float> pixels = random_floats(std::size_t{8} * static_cast<std::size_t>(count), 1);
      std::vector<const float*> rows;
      for (int i = 0; i < 8; ++i) rows.push_back(pixels.data() + i * count);
      const float* const* centre = rows.data() + 3;
      std::vector<float> out(static_cast<std::size_t>(count), -1);
      blur_kernels(GetParam()).sum_rows(centre, shift, weights.data(), kPairs, 16 * shift, count, out.data());
      for (int x = 0; x < count; ++x) {
        float sum = x < 16 * shift ? -1.0F : 0.0F;
        for (int k = 0; k < kPairs && x >= 16 * shift; ++k)
          sum += weights[static_cast<std::size_t>(k)] * (centre[-k][x] + centre[k + shift][x]);
        ASSERT_EQ(out[static_cast<std::size_t>(x)], sum) << count << ' ' << shift << ' ' << x;
      }
    }
  }
}

TEST_P(BlurKernelsTest, BlurRowIsTheWeightedSumBitForBit) {
  const std::vector<float> weights{0.3F, 0.2F, 0.1F, 0.05F};
  for (const int radius : {0, 1, 3}) {
    for (const int count : {16, 64, 144}) {
      const std::vector<float> in =
          random_floats(static_cast<std::size_t>(count) + std::size_t{2} * kMargin, 2);
      std::vector<float> out(static_cast<std::size_t>(count));
      const float* centre = in.data() + kMargin;
      blur_kernels(GetParam()).blur_row(centre, weights.data(), radius, count, out.data());
      for (int x = 0; x < count; ++x) {
        float sum = weights[0] * centre[x];
        for (int k = 1; k <= radius; ++k)
          sum += weights[static_cast<std::size_t>(k)] * (centre[x - k] + centre[x + k]);
        ASSERT_EQ(out[static_cast<std::size_t>(x)], sum) << radius << ' ' << count << ' ' << x;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Sets, BlurKernelsTest, testing::ValuesIn(available_instruction_sets()),
                         [](const auto& set) { return "set" + std::to_string(static_cast<int>(set.param)); });

}  // namespace
}  // namespace cairn
