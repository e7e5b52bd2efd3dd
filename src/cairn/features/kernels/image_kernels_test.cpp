// SPDX-License-Identifier: Apache-2.0
#include "cairn/features/kernels/image_kernels.h"

#include <cmath>
#include <vector>

#include "cairn/core/random.h"
#include "cairn/testing/features/each_instruction_set.h"
#include "cairn/testing/image/random_images.h"

namespace cairn {
namespace {

using testkit::EachInstructionSet;
using testkit::name_of_parameter;
using testkit::random_image;

using ImageKernelsTest = EachInstructionSet;

TEST_P(ImageKernelsTest, resize_weighs_two_pixels_each) {
  const GrayImage row = random_image(64, 1, 1);
  Random random(2);
  std::vector<ResizeBlock> blocks(5);
  for (ResizeBlock& block : blocks) {
    block.first = static_cast<std::int32_t>(random.index(64 - 16 + 1));
    for (int i = 0; i < 16; ++i) block.source[i] = static_cast<std::uint8_t>(random.index(16));
    for (int i = 0; i < 16; i += 2) {
      block.weight[i] = static_cast<std::int8_t>(random.index(65));
      block.weight[i + 1] = static_cast<std::int8_t>(64 - block.weight[i]);
    }
  }
  std::vector<std::int16_t> out(40);
  image_kernels(GetParam()).resize_row(row.data(), blocks.data(), 5, out.data());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const ResizeBlock& block = blocks[i / 8];
    int expected = 0;
    for (std::size_t k = 2 * (i % 8); k < 2 * (i % 8) + 2; ++k)
      expected += row(block.first + block.source[k], 0) * block.weight[k];
    ASSERT_EQ(out[i], expected);
  }
}

TEST_P(ImageKernelsTest, blend_is_linear_between_rows) {
  Random random(3);
  for (const int width : {1, 15, 64, 131}) {
    const auto size = static_cast<std::size_t>(width);
    std::vector<std::int16_t> upper(size), lower(size);
    for (auto& value : upper) value = static_cast<std::int16_t>(random.index(255 * 64 + 1));
    for (auto& value : lower) value = static_cast<std::int16_t>(random.index(255 * 64 + 1));
    for (const int weight : {0, 1, 9999, 16384, 32767}) {
      std::vector<std::uint8_t> out(size);
      image_kernels(GetParam()).blend_rows(upper.data(), lower.data(), weight, width, out.data());
      for (std::size_t i = 0; i < size; ++i) {
        const double exact = (upper[i] + (lower[i] - upper[i]) * weight / 32768.0) / 64;
        ASSERT_NEAR(out[i], exact, 0.5 + 1.0 / 64);
        const int part = ((lower[i] - upper[i]) * weight + 16384) >> 15;
        ASSERT_EQ(out[i], (upper[i] + part + 32) >> 6);
      }
    }
  }
}

TEST_P(ImageKernelsTest, blur_weighs_seven_rows) {
  for (const int width : {1, 31, 64, 65, 200}) {
    const GrayImage image = random_image(width, 7, static_cast<std::uint64_t>(width));
    const std::uint8_t* rows[7];
    for (int k = 0; k < 7; ++k) rows[k] = image.row(k);
    std::vector<std::uint8_t> out(static_cast<std::size_t>(width));
    image_kernels(GetParam()).blur_seven(rows, width, out.data());
    const int weights[] = {18, 34, 49, 54, 49, 34, 18};
    for (int i = 0; i < width; ++i) {
      int sum = 128;
      for (int k = 0; k < 7; ++k) sum += weights[k] * image(i, k);
      ASSERT_EQ(out[static_cast<std::size_t>(i)], sum / 256);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Sets, ImageKernelsTest, testing::ValuesIn(available_instruction_sets()),
                         name_of_parameter);

}  // namespace
}  // namespace cairn
