// SPDX-License-Identifier: Apache-2.0
#include "cairn/matching/kernels/disparity_kernels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <vector>

#include "cairn/core/random.h"
#include "cairn/simd/available.h"

namespace cairn {
namespace {

constexpr int kWidth = 64, kHeight = 13;
constexpr int kU = 32, kV = 6;

struct Images {
  std::vector<std::uint8_t> left, right;
};

Images random_images(std::uint64_t seed) {
  Random random(seed);
  Images images{std::vector<std::uint8_t>(kWidth * kHeight), std::vector<std::uint8_t>(kWidth * kHeight)};
  for (auto& pixel : images.left) pixel = static_cast<std::uint8_t>(random.index(256));
  for (auto& pixel : images.right) pixel = static_cast<std::uint8_t>(random.index(256));
  return images;
}

const std::uint8_t* centre(const std::vector<std::uint8_t>& image) {
  return image.data() + kV * kWidth + kU;
}

/// All that the kernels give for one window.
struct Results {
  DisparityNormal normal;
  DisparityResiduals residuals;
  DisparityDifference difference;
};

Results compute(InstructionSet set, const Images& images, float disparity, float row_slope) {
  Results results;  // doubles alone: no padding
  DisparityWindow window;
  const DisparityKernels& kernels = disparity_kernels(set);
  kernels.prepare(centre(images.left), kWidth, window, results.normal);
  kernels.compare(window, centre(images.right), kWidth, disparity, row_slope, results.residuals);
  kernels.difference(window, centre(images.right), kWidth, static_cast<int>(disparity), results.difference);
  return results;
}

std::vector<std::uint64_t> bits(const Results& results) {
  std::vector<std::uint64_t> words(sizeof results / sizeof(std::uint64_t));
  std::memcpy(words.data(), &results, sizeof results);
  return words;
}

double weight(int x, int y) {
  return x == -8 ? 0 : std::exp(-(x * x + y * y) / 32.0);
}

double slow_gradient(const std::vector<std::uint8_t>& image, int x, int y) {
  const auto at = [&](int dx) { return double{static_cast<double>(centre(image)[y * kWidth + x + dx])}; };
  return (8 * (at(1) - at(-1)) - (at(2) - at(-2))) / 12;
}

/// Lagrange's formula, as the textbooks have it.
double slow_interpolate(const std::vector<std::uint8_t>& image, double x, int y) {
  const int whole = static_cast<int>(std::floor(x));
  double level = 0;
  for (int i = whole - 2; i <= whole + 3; ++i) {
    double basis = 1;
    for (int j = whole - 2; j <= whole + 3; ++j)
      if (j != i) basis *= (x - j) / (i - j);
    level += basis * centre(image)[y * kWidth + i];
  }
  return level;
}

/// j of the definition.
std::vector<double> unknowns(const Images& images, int x, int y) {
  const double g = slow_gradient(images.left, x, y);
  return {g, g * x, g * y, centre(images.left)[y * kWidth + x] - 128.0, 1};
}

void expect_close(double found, double expected, double scale) {
  EXPECT_NEAR(found, expected, 2e-5 * scale);
}

class DisparityKernelsTest : public testing::TestWithParam<InstructionSet> {};

TEST_P(DisparityKernelsTest, sums_are_the_definition) {
  const Images images = random_images(1);
  const double disparity = 2.3, row_slope = 0.31;
  const Results results =
      compute(GetParam(), images, static_cast<float>(disparity), static_cast<float>(row_slope));
  double matrix[5][5] = {}, projected[5] = {}, magnitude[5] = {}, squares = 0, sum = 0, whole_squares = 0;
  for (int y = -6; y <= 6; ++y) {
    for (int x = -8; x <= 7; ++x) {
      const auto j = unknowns(images, x, y);
      const double w = weight(x, y), l = centre(images.left)[y * kWidth + x];
      const double residual = l - slow_interpolate(images.right, x - disparity - row_slope * y, y);
      const double whole = l - centre(images.right)[y * kWidth + x - 2];
      for (std::size_t a = 0; a < 5; ++a) {
        for (std::size_t b = 0; b < 5; ++b) matrix[a][b] += w * j[a] * j[b];
        projected[a] += w * j[a] * residual;
        magnitude[a] += std::abs(w * j[a] * residual);
      }
      squares += w * residual * residual;
      sum += w * whole, whole_squares += w * whole * whole;
    }
  }
  std::size_t next = 0;
  for (std::size_t a = 0; a < 5; ++a)
    for (std::size_t b = a; b < 5; ++b)
      expect_close(results.normal.matrix[next++], matrix[a][b], std::sqrt(matrix[a][a] * matrix[b][b]));
  for (std::size_t a = 0; a < 5; ++a)
    expect_close(results.residuals.projected[a], projected[a], magnitude[a]);
  expect_close(results.residuals.squares, squares, squares);
  expect_close(results.difference.sum, sum, 100 * 128);
  expect_close(results.difference.squares, whole_squares, whole_squares);
}

TEST_P(DisparityKernelsTest, bits_are_those_of_plain) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Images images = random_images(seed);
    for (const float disparity : {-3.F, -0.25F, 0.F, 0.999F, 7.61F}) {
      for (const float row_slope : {-0.4F, 0.F, 0.77F}) {
        const Results plain = compute(InstructionSet::plain, images, disparity, row_slope);
        const Results results = compute(GetParam(), images, disparity, row_slope);
        ASSERT_EQ(bits(results), bits(plain)) << disparity << ' ' << row_slope;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Sets, DisparityKernelsTest, testing::ValuesIn(available_instruction_sets()),
                         [](const auto& set) { return "set" + std::to_string(static_cast<int>(set.param)); });

}  // namespace
}  // namespace cairn
