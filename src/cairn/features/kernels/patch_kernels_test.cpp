// SPDX-License-Identifier: Apache-2.0
#include "cairn/features/kernels/patch_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "cairn/core/random.h"
#include "cairn/simd/available.h"

namespace cairn {
namespace {

constexpr std::size_t kSamples = std::size_t{kDescriptorSide} * kDescriptorSide;

std::vector<float> random_floats(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<float> values(count);
  for (float& value : values) value = static_cast<float>(random.uniform(0, 255));
  return values;
}

CellWeights random_weights(std::uint64_t seed) {
  Random random(seed);
  CellWeights weights{};
  for (auto& cell : weights.weights)
    for (float& weight : cell) weight = static_cast<float>(random.uniform());
  return weights;
}

class PatchKernelsTest : public testing::TestWithParam<InstructionSet> {
 protected:
  const PatchKernels& kernels_ = patch_kernels(GetParam());
  const PatchKernels& plain_ = patch_kernels(InstructionSet::plain);
};

TEST_P(PatchKernelsTest, SamplesALinearImageExactlyAndItsBorderOutside) {
  constexpr int kWidth = 37, kHeight = 29, kStride = 40, kSide = 16;
  std::vector<float> pixels(std::size_t{kStride} * kHeight);
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u) pixels.data()[v * kStride + u] = static_cast<float>(2 * u + 3 * v);
  const PatchGrid grid{pixels.data(), kWidth, kHeight, kStride, 14.25F, 20.5F, 1.5F, 0.75F, 7.5F};
  std::array<float, kSide * kSide> samples{};
  kernels_.sample(grid, kSide, samples.data());
  for (int i = 0; i < kSide; ++i) {
    for (int j = 0; j < kSide; ++j) {
      const double along = j - 7.5, down = i - 7.5;
      const double x = std::clamp(14.25 + along * 1.5 - down * 0.75, 0.0, kWidth - 1.0);
      const double y = std::clamp(20.5 + along * 0.75 + down * 1.5, 0.0, kHeight - 1.0);
      ASSERT_NEAR(samples.data()[i * kSide + j], 2 * x + 3 * y, 1e-3) << i << ' ' << j;
    }
  }
}

TEST_P(PatchKernelsTest, SamplesTheSameBits) {
  const std::vector<float> pixels = random_floats(std::size_t{64} * 64, 1);
  Random random(2);
  for (int trial = 0; trial < 50; ++trial) {
    const auto any = [&](double low, double high) { return static_cast<float>(random.uniform(low, high)); };
    const PatchGrid grid{pixels.data(), 60, 64, 64, any(-9, 70), any(-9, 70), any(-4, 4), any(-4, 4), 7.5F};
    std::array<float, kSamples> samples{}, expected{};
    kernels_.sample(grid, kDescriptorSide, samples.data());
    plain_.sample(grid, kDescriptorSide, expected.data());
    ASSERT_EQ(samples, expected);
  }
}

TEST_P(PatchKernelsTest, OrientationsFallIntoTheirBin) {
  const std::vector<float> weights(kSamples, 1.0F);
  for (int bin = 0; bin < kOrientationBins; ++bin) {
    const double angle = 2 * std::numbers::pi * (bin + 0.4) / kOrientationBins;
    std::array<float, kSamples + 32> samples{};
    for (int i = 0; i < kOrientationSide; ++i)
      for (int j = 0; j < kOrientationSide; ++j)
        samples.data()[i * kOrientationSide + j] =
            static_cast<float>(10 * (j * std::cos(angle) + i * std::sin(angle)));
    std::vector<float> weighted = weights;
    for (int i = 0; i < kOrientationSide; ++i) weighted.data()[16 * i + 15] = 0;
    std::array<float, kOrientationBins> histogram{};
    kernels_.orientations(samples.data(), weighted.data(), histogram.data());
    for (int b = 0; b < kOrientationBins; ++b)
      EXPECT_NEAR(histogram[static_cast<std::size_t>(b)], b == bin ? 225 * 20 : 0, 1) << bin << ' ' << b;
  }
}

TEST_P(PatchKernelsTest, OrientationsAreTheSameBits) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const std::vector<float> samples = random_floats(kSamples + 32, seed),
                             weights = random_floats(kSamples, 99);
    std::array<float, kOrientationBins> histogram{}, expected{};
    kernels_.orientations(samples.data(), weights.data(), histogram.data());
    plain_.orientations(samples.data(), weights.data(), expected.data());
    ASSERT_EQ(histogram, expected);
  }
}

TEST_P(PatchKernelsTest, DescriptorsAreTheSameBytes) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const std::vector<float> samples = random_floats(kSamples + 32, seed);
    const CellWeights weights = random_weights(seed);
    for (const bool root : {false, true}) {
      std::array<std::uint8_t, kDescriptorBytes> descriptor{}, expected{};
      kernels_.describe(samples.data(), weights, root, descriptor.data());
      plain_.describe(samples.data(), weights, root, expected.data());
      ASSERT_EQ(descriptor, expected);
    }
  }
}

TEST_P(PatchKernelsTest, AnEvenPatchIsDescribedByZeros) {
  const std::vector<float> samples(kSamples + 32, 77.0F);
  for (const bool root : {false, true}) {
    std::array<std::uint8_t, kDescriptorBytes> descriptor{};
    descriptor.fill(1);
    kernels_.describe(samples.data(), random_weights(1), root, descriptor.data());
    EXPECT_EQ(descriptor, (std::array<std::uint8_t, kDescriptorBytes>{}));
  }
}

INSTANTIATE_TEST_SUITE_P(Sets, PatchKernelsTest, testing::ValuesIn(available_instruction_sets()),
                         [](const auto& set) { return "set" + std::to_string(static_cast<int>(set.param)); });

}  // namespace
}  // namespace cairn
