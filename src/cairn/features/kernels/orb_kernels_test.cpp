// SPDX-License-Identifier: Apache-2.0
#include "cairn/features/kernels/orb_kernels.h"

#include <cmath>
#include <vector>

#include "cairn/features/orb_pattern.h"
#include "cairn/testing/features/each_instruction_set.h"
#include "cairn/testing/image/random_images.h"

namespace cairn {
namespace {

using testkit::EachInstructionSet;
using testkit::name_of_parameter;
using testkit::random_image;

using OrbKernelsTest = EachInstructionSet;

TEST_P(OrbKernelsTest, moments_are_those_of_a_disc) {
  const GrayImage image = random_image(50, 45, 1);
  for (int u = 15; u < 34; ++u) {
    std::int32_t m10 = 0, m01 = 0, expected_m10 = 0, expected_m01 = 0;
    for (int y = -15; y <= 15; ++y) {
      for (int x = -15; x <= 15; ++x) {
        if (x * x + y * y > 225) continue;
        expected_m10 += x * image(u + x, 20 + y);
        expected_m01 += y * image(u + x, 20 + y);
      }
    }
    orb_kernels(GetParam()).moments(image.row(20) + u, image.width(), &m10, &m01);
    ASSERT_EQ(m10, expected_m10);
    ASSERT_EQ(m01, expected_m01);
  }
}

TEST_P(OrbKernelsTest, brief_compares_the_turned_pairs) {
  const GrayImage image = random_image(45, 45, 2);
  const BriefPattern& pattern = orb_pattern();
  for (int degrees = 0; degrees < 360; degrees += 7) {
    const float cosine = std::cos(static_cast<float>(degrees) * 0.0174533F);
    const float sine = std::sin(static_cast<float>(degrees) * 0.0174533F);
    std::vector<std::uint8_t> bits(32);
    orb_kernels(GetParam()).brief(image.row(22) + 22, image.width(), pattern, cosine, sine, bits.data());
    const auto value = [&](int i) {
      const float u = pattern.u[i] * cosine - pattern.v[i] * sine;
      const float v = pattern.u[i] * sine + pattern.v[i] * cosine;
      return image(22 + static_cast<int>(std::lrint(u)), 22 + static_cast<int>(std::lrint(v)));
    };
    for (int i = 0; i < kBriefBits; ++i) {
      const int bit = bits[static_cast<std::size_t>(i / 8)] >> (i % 8) & 1;
      ASSERT_EQ(bit, value(i) < value(kBriefBits + i) ? 1 : 0) << "pair " << i << " at " << degrees;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Sets, OrbKernelsTest, testing::ValuesIn(available_instruction_sets()),
                         name_of_parameter);

}  // namespace
}  // namespace cairn
