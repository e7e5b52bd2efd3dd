// SPDX-License-Identifier: Apache-2.0
#include "cairn/simulate/canvas.h"

#include <gtest/gtest.h>

#include <cmath>

namespace cairn {
namespace {

TEST(canvas, shape_covers_its_place_and_area) {
  Canvas canvas(1.0, 0.5, 0.01, Color::Zero());
  canvas.draw({{0.3, 0.2}, {0.1, 0.05}, 0.4, false, Color(200, 200, 200), 1});
  double sum = 0;
  for (std::size_t i = 0; i < canvas.image().size(); ++i) sum += canvas.image().data()[i].r;
  EXPECT_NEAR(sum / 200 * 1e-4, 0.2 * 0.1, 0.0005);  // square metres
  EXPECT_EQ(canvas.image()(29, 19).r, 200);
  EXPECT_EQ(canvas.image()(60, 19).r, 0);
}

TEST(canvas, noise_has_the_deviation_asked_for) {
  Canvas canvas(4, 4, 0.01, Color::Constant(128));
  canvas.add_noise({0.3, 4, 0.8, 15, 0}, 5);
  double sum = 0, sum_of_squares = 0;
  const auto count = static_cast<double>(canvas.image().size());
  for (std::size_t i = 0; i < canvas.image().size(); ++i) {
    const double level = canvas.image().data()[i].g;
    sum += level;
    sum_of_squares += level * level;
  }
  const double mean = sum / count;
  EXPECT_NEAR(mean, 128, 3);
  EXPECT_NEAR(std::sqrt(sum_of_squares / count - mean * mean), 15, 3);
}

TEST(canvas, scatter_repeats_itself) {
  const auto paint = [] {
    Canvas canvas(1, 1, 0.01, Color::Constant(100));
    Random random(7, 3);
    canvas.scatter({60, 0.01, 0.1, 0.9F, 0.5F}, random);
    return std::move(canvas).take();
  };
  EXPECT_TRUE(paint() == paint());
  EXPECT_FALSE(paint() == Canvas(1, 1, 0.01, Color::Constant(100)).image());
}

TEST(canvas, random_colours_keep_to_their_limits) {
  Random random(11);
  for (int i = 0; i < 1000; ++i) {
    const Color color = random_color(random, 0.5F, 40, 200);
    EXPECT_LE(color.maxCoeff(), 200);
    EXPECT_GE(color.maxCoeff(), 40);
    EXPECT_GE(color.minCoeff(), 0.49F * color.maxCoeff());
  }
}

}  // namespace
}  // namespace cairn
