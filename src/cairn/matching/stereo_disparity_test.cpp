// SPDX-License-Identifier: Apache-2.0
#include "cairn/matching/stereo_disparity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "cairn/core/error.h"
#include "cairn/core/random.h"
#include "cairn/testing/image/textured_pair.h"

namespace cairn {
namespace {

using testkit::make_pair;
using testkit::Surface;
using testkit::TestPair;
using testkit::Waves;

/// Errors and errors in units of their sigma, over places of a pair.
struct Errors {
  int count = 0;
  double mean = 0, squares = 0, in_sigmas_squares = 0;

  void add(double error, double sigma) {
    ++count;
    mean += (error - mean) / count;
    squares += (error * error - squares) / count;
    in_sigmas_squares += (error * error / (sigma * sigma) - in_sigmas_squares) / count;
  }
};

/// Measures at many places between pixels, from a guess that is off by up to half a pixel.
void measure_places(const TestPair& pair, const Surface& surface, Errors& errors) {
  Random random(3);
  for (int i = 0; i < 60; ++i) {
    const double u = random.uniform(60, pair.left.width() - 30),
                 v = random.uniform(10, pair.left.height() - 10);
    const double disparity = surface.disparity(pair.left, u, v);
    const DisparityResult result =
        measure_disparity(pair.left, pair.right, u, v, disparity + random.uniform(-0.5, 0.5), 1);
    if (result.status == DisparityStatus::measured)
      errors.add(result.measured.disparity - disparity, result.measured.sigma_px);
  }
}

TEST(MeasureDisparity, fraction_of_a_pixel_pulls_it_to_no_side) {
  constexpr int kTextures = 4;
  for (int tenth = 0; tenth < 10; ++tenth) {
    Errors errors;
    const Surface surface{12 + 0.1 * tenth, 0, 0};
    for (std::uint64_t seed = 0; seed < kTextures; ++seed)
      measure_places(make_pair(160, 60, surface, Waves(4, 25, seed), 1, 2), surface, errors);
    EXPECT_GT(errors.count, 0.98 * kTextures * 60);
    EXPECT_NEAR(errors.mean, 0, 0.005) << "at " << surface.at_centre;
    EXPECT_LT(std::sqrt(errors.squares), 0.05) << "at " << surface.at_centre;
  }
}

TEST(MeasureDisparity, slanted_surfaces_are_measured_at_the_place_asked_for) {
  for (const Surface& surface : {Surface{20.3, 0, 0.33}, Surface{20.3, 0.1, 0}, Surface{20.3, -0.1, -0.2}}) {
    Errors errors;
    for (std::uint64_t seed = 0; seed < 8; ++seed)
      measure_places(make_pair(160, 40, surface, Waves(6, 25, seed), 1, 2), surface, errors);
    EXPECT_GT(errors.count, 0.9 * 8 * 60);
    EXPECT_NEAR(errors.mean, 0, 0.02) << surface.slope_u << ' ' << surface.slope_v;
    EXPECT_LT(std::sqrt(errors.squares), 0.15) << surface.slope_u << ' ' << surface.slope_v;
  }
}

TEST(MeasureDisparity, another_exposure_changes_nothing) {
  const Surface surface{12.4, 0, 0};
  Errors errors;
  for (std::uint64_t seed = 0; seed < 8; ++seed)
    measure_places(make_pair(160, 60, surface, Waves(5, 25, seed), 1.2, 2), surface, errors);
  EXPECT_GT(errors.count, 0.98 * 8 * 60);
  EXPECT_NEAR(errors.mean, 0, 0.005);
}

TEST(MeasureDisparity, sigma_is_of_the_size_of_the_errors) {
  for (const double deviation : {1.0, 3.0, 8.0}) {
    Errors errors;
    const Surface surface{12.4, 0, 0};
    for (std::uint64_t seed = 0; seed < 8; ++seed)
      measure_places(make_pair(160, 60, surface, Waves(6, 25, seed), 1, deviation), surface, errors);
    EXPECT_GT(std::sqrt(errors.in_sigmas_squares), 0.4) << deviation;
    EXPECT_LT(std::sqrt(errors.in_sigmas_squares), 1.4) << deviation;
  }
}

TEST(MeasureDisparity, finds_it_within_its_reach) {
  const Surface surface{20.2, 0, 0};
  const TestPair pair = make_pair(160, 60, surface, Waves(8, 25, 1), 1, 1);
  for (const double off : {-3.4, -2.5, 2.5, 3.9}) {
    const DisparityResult result = measure_disparity(pair.left, pair.right, 90, 30, 20.2 + off, 4);
    ASSERT_EQ(result.status, DisparityStatus::measured) << off;
    EXPECT_NEAR(result.measured.disparity, 20.2, 0.1) << off;
    EXPECT_GT(result.measured.correlation, 0.95) << off;
  }
}

TEST(MeasureDisparity, one_colour_has_no_disparity) {
  const GrayImage plain(100, 50, 90);
  EXPECT_EQ(measure_disparity(plain, plain, 50, 25, 5, 1).status, DisparityStatus::no_texture);
  GrayImage rows(100, 50);  // changes only from row to row
  for (int v = 0; v < 50; ++v)
    for (int u = 0; u < 100; ++u) rows(u, v) = static_cast<std::uint8_t>(v * 37 % 251);
  EXPECT_EQ(measure_disparity(rows, rows, 50, 25, 5, 1).status, DisparityStatus::no_texture);
}

TEST(MeasureDisparity, equal_images_have_a_sigma_above_nothing) {
  const TestPair pair = make_pair(100, 50, {0, 0, 0}, Waves(6, 25, 1), 1, 0);
  const DisparityResult result = measure_disparity(pair.left, pair.left, 50, 25, 0.2, 1);
  ASSERT_EQ(result.status, DisparityStatus::measured);
  EXPECT_NEAR(result.measured.disparity, 0, 0.01);
  EXPECT_GT(result.measured.sigma_px, 0.001);
  EXPECT_NEAR(result.measured.correlation, 1, 1e-3);
}

TEST(MeasureDisparity, no_pixel_outside_is_read) {
  const TestPair pair = make_pair(60, 40, {3, 0, 0}, Waves(6, 25, 1), 1, 1);
  for (int v = -2; v < 42; ++v) {
    for (int u = -2; u < 62; ++u) {
      for (const double guess : {-30.0, 0.0, 3.0, 40.0, 1e12, -1e12}) {
        const DisparityResult result = measure_disparity(pair.left, pair.right, u, v, guess, 2);
        const bool inside = u >= 10 && u <= 50 && v >= 6 && v <= 33;
        EXPECT_TRUE(inside || result.status == DisparityStatus::no_room) << u << ' ' << v;
      }
    }
  }
  const GrayImage none, dot(1, 1), line(500, 3);
  EXPECT_EQ(measure_disparity(none, none, 0, 0, 0, 1).status, DisparityStatus::no_room);
  EXPECT_EQ(measure_disparity(dot, dot, 0, 0, 0, 1).status, DisparityStatus::no_room);
  EXPECT_EQ(measure_disparity(line, line, 250, 1, 0, 1).status, DisparityStatus::no_room);
}

TEST(MeasureDisparity, refuses_what_has_no_meaning) {
  const GrayImage small(60, 40), large(61, 40);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)measure_disparity(small, large, 30, 20, 0, 1), PreconditionError);
  EXPECT_THROW((void)measure_disparity(small, small, 30, 20, 0, -1), PreconditionError);
  EXPECT_THROW((void)measure_disparity(small, small, 30, 20, 0, nan), PreconditionError);
  EXPECT_EQ(measure_disparity(small, small, nan, 20, 0, 1).status, DisparityStatus::no_room);
  EXPECT_EQ(measure_disparity(small, small, 30, 20, nan, 1).status, DisparityStatus::no_room);
}

TEST(FindDisparity, finds_the_place_from_nothing) {
  const Surface surface{23.4, 0.02, 0.03};
  const TestPair pair = make_pair(200, 60, surface, Waves(5, 25, 2), 1, 2);
  int found = 0;
  for (int u = 60; u < 180; u += 10) {
    for (int v = 10; v < 50; v += 10) {
      const auto disparity = find_disparity(pair.left, pair.right, u, v, 0, 45);
      if (!disparity) continue;
      ++found;
      EXPECT_NEAR(*disparity, surface.disparity(pair.left, u, v), 1.0);
    }
  }
  EXPECT_GE(found, 40);  // of 48
}

TEST(FindDisparity, repeated_texture_has_no_place) {
  constexpr int kPeriod = 12;
  TestPair pair{GrayImage(200, 60), GrayImage(200, 60)};
  for (int v = 0; v < 60; ++v) {
    for (int u = 0; u < 200; ++u) {
      pair.left(u, v) = testkit::to_gray(110 + 60 * std::sin(2 * std::numbers::pi * u / kPeriod));
      pair.right(u, v) = testkit::to_gray(110 + 60 * std::sin(2 * std::numbers::pi * (u + 5) / kPeriod));
    }
  }
  EXPECT_FALSE(find_disparity(pair.left, pair.right, 100, 30, 0, 45));
  EXPECT_EQ(find_disparity(pair.left, pair.right, 100, 30, 0, 9), 5);  // one period: one place
}

TEST(FindDisparity, what_the_other_image_does_not_show_has_no_place) {
  const TestPair pair = make_pair(200, 60, {14, 0, 0}, Waves(5, 25, 2), 1, 2);
  const TestPair other = make_pair(200, 60, {14, 0, 0}, Waves(5, 25, 77), 1, 2);
  int found = 0;
  for (int u = 60; u < 180; u += 4) found += find_disparity(pair.left, other.right, u, 30, 0, 45) ? 1 : 0;
  EXPECT_LE(found, 1);  // of 30
}

TEST(FindDisparity, no_pixel_outside_is_read) {
  const TestPair pair = make_pair(60, 40, {14, 0, 0}, Waves(5, 25, 2), 1, 2);
  for (int u = -1; u <= 60; ++u) {
    for (int v = -1; v <= 40; ++v) (void)find_disparity(pair.left, pair.right, u, v, 0, 100);
  }
}

}  // namespace
}  // namespace cairn
