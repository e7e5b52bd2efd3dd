// SPDX-License-Identifier: Apache-2.0
#include "cairn/features/sift_scale_space.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "cairn/core/random.h"

namespace cairn {
namespace {

GrayImage noise(int width, int height) {
  Random random(3);
  GrayImage image(width, height);
  for (std::size_t i = 0; i < image.size(); ++i)
    image.data()[i] = static_cast<std::uint8_t>(random.index(256));
  return image;
}

/// Mean and variance of place along x, weighted by the pixels.
struct Spread {
  double mean_x, mean_y, variance_x;
};

Spread spread_of(const OctaveRows& rows, int level, const ScaleLevel& size) {
  double sum = 0, sum_x = 0, sum_y = 0, sum_xx = 0;
  for (int v = 0; v < size.height; ++v) {
    for (int u = 0; u < size.width; ++u) {
      const double weight = static_cast<double>(rows.row(level, v)[u]);
      sum += weight, sum_x += weight * u, sum_y += weight * v, sum_xx += weight * u * u;
    }
  }
  return {sum_x / sum, sum_y / sum, sum_xx / sum - std::pow(sum_x / sum, 2)};
}

TEST(ScaleSpace, each_level_smooths_a_point_by_its_sigma_around_its_place) {
  GrayImage image(201, 161, 0);
  image(90, 70) = 250;
  ScaleSpace space(image.width(), image.height(), 3);
  space.build(image, Executor());
  constexpr double kImageVariance = 0.25 * 0.25;  // that the image is taken to have already
  for (int octave = 0; octave < 3; ++octave) {
    const ScaleLevel& base = space.level(octave, 0);
    const OctaveRows rows(space, octave, 0, base.height);
    for (int i = 0; i < 6; ++i) {
      const Spread spread = spread_of(rows, i, base);
      const double pixel = ScaleSpace::pixel_size(octave);
      EXPECT_NEAR(spread.mean_x * pixel, 90, 0.02) << octave << ' ' << i;
      EXPECT_NEAR(spread.mean_y * pixel, 70, 0.02) << octave << ' ' << i;
      const double sigma = std::sqrt(spread.variance_x * pixel * pixel + kImageVariance);
      EXPECT_NEAR(sigma / (pixel * space.sigma(i)), 1, 0.03) << octave << ' ' << i;
    }
  }
}

TEST(ScaleSpace, one_colour_stays) {
  ScaleSpace space(50, 37, 2);
  space.build(GrayImage(50, 37, 200), Executor());
  ASSERT_EQ(space.octave_count(), 3);
  for (int octave = 0; octave < space.octave_count(); ++octave)
    for (int i = 0; i < space.level_count(octave); ++i)
      for (int v = 0; v < space.level(octave, i).height; ++v)
        for (int u = 0; u < space.level(octave, i).width; ++u)
          ASSERT_NEAR(space.level(octave, i).row(v)[u], 200, 1e-3)
              << octave << ' ' << i << ' ' << u << ' ' << v;
}

TEST(ScaleSpace, has_the_same_bits_at_any_number_of_threads) {
  const GrayImage image = noise(150, 131);
  ScaleSpace one(150, 131, 3), three(150, 131, 3);
  one.build(image, Executor(1));
  three.build(image, Executor(3));
  ASSERT_GT(one.octave_count(), 0);
  for (int octave = 0; octave < one.octave_count(); ++octave)
    for (int i = 0; i < one.level_count(octave); ++i)
      for (int v = 0; v < one.level(octave, i).height; ++v)
        ASSERT_EQ(std::memcmp(one.level(octave, i).row(v), three.level(octave, i).row(v),
                              static_cast<std::size_t>(one.level(octave, i).width) * sizeof(float)),
                  0);
}

TEST(OctaveRows, do_not_depend_on_which_are_asked_for) {
  const GrayImage image = noise(150, 131);
  for (const int layers : {1, 3}) {
    ScaleSpace space(150, 131, layers);
    space.build(image, Executor());
    const int width = space.level(0, 0).width, height = space.level(0, 0).height;
    const OctaveRows all(space, 0, -5, height + 5), some(space, 0, 37, 101);
    ASSERT_EQ(all.begin(), 0);
    ASSERT_EQ(all.end(), height);
    for (int i = 0; i < layers + 3; ++i)
      for (int y = 37; y < 101; ++y)
        ASSERT_EQ(std::memcmp(all.row(i, y), some.row(i, y), static_cast<std::size_t>(width) * sizeof(float)),
                  0);
  }
}

TEST(ScaleSpace, of_a_tiny_image_is_empty) {
  for (const auto& [width, height] : {std::pair{0, 0}, {1, 1}, {1, 500}, {500, 7}}) {
    ScaleSpace space(width, height, 3);
    space.build(GrayImage(width, height), Executor());
    EXPECT_EQ(space.octave_count(), 0);
  }
}

}  // namespace
}  // namespace cairn
