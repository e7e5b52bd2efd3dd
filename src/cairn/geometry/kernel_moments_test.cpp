// SPDX-License-Identifier: Apache-2.0
#include "cairn/geometry/kernel_moments.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "cairn/core/random.h"
#include "cairn/geometry/inlier_limits.h"

namespace cairn {
namespace {

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

TEST(KernelMoments, are_those_of_chi_square_without_kernel_and_limit) {
  for (const int dimension : {2, 3}) {
    const KernelMoments plain = kernel_moments(RobustKernel::none, 1, dimension, kNoLimit);
    EXPECT_NEAR(plain.share, 1, 1e-5);
    EXPECT_NEAR(plain.squares, dimension, 1e-5);
    EXPECT_NEAR(plain.sensitivity, 1, 1e-5);
    EXPECT_NEAR(plain.force, 1, 1e-5);
    EXPECT_NEAR(plain.expected_squares(0.9), 0.9 * dimension, 1e-5);
  }
}

/// A chi-square variable with n degrees of freedom below its 95 % quantile q has the mean n P(n + 2, q) /
/// 0.95.
TEST(KernelMoments, know_what_the_limit_cuts_off) {
  const KernelMoments two = kernel_moments(RobustKernel::none, 1, 2, kInlierLimit2);
  EXPECT_NEAR(two.share, 0.95, 1e-4);
  EXPECT_NEAR(two.squares, 2 * (1 - 0.05 * (1 + kInlierLimit2 / 2)) / 0.95, 1e-3);
  const KernelMoments three = kernel_moments(RobustKernel::none, 1, 3, kInlierLimit3);
  EXPECT_NEAR(three.share, 0.95, 1e-4);
  // P(5, q) = P(3, q) - (q / 2)^1.5 exp(-q / 2) / Gamma(2.5)
  const double five =
      0.95 - std::pow(kInlierLimit3 / 2, 1.5) * std::exp(-kInlierLimit3 / 2) / std::tgamma(2.5);
  EXPECT_NEAR(three.squares, 3 * five / 0.95, 1e-3);
}

TEST(KernelMoments, are_the_means_over_random_errors) {
  constexpr int kErrors = 400'000;
  constexpr double kScale = 1.5, kLimit = kInlierLimit3, kStd = 0.95;
  for (const auto kernel : {RobustKernel::huber, RobustKernel::cauchy, RobustKernel::geman_mcclure}) {
    const KernelMoments moments = kernel_moments(kernel, kScale, 3, kLimit);
    Random random(1);
    double weight = 0, squares = 0, force = 0, smaller = 0;
    int count = 0, smaller_count = 0;
    for (int i = 0; i < kErrors; ++i) {
      double s = 0;
      for (int axis = 0; axis < 3; ++axis) s += std::pow(random.normal(), 2);
      const double of_residual = kStd * kStd * s;
      if (of_residual < kLimit)
        smaller += kernel_weight(kernel, kScale, of_residual) * of_residual, ++smaller_count;
      if (s >= kLimit) continue;
      const double w = kernel_weight(kernel, kScale, s);
      weight += w, squares += w * s, force += w * w * s, ++count;
    }
    EXPECT_NEAR(moments.weight, weight / count, 0.003);
    EXPECT_NEAR(moments.squares, squares / count, 0.01);
    EXPECT_NEAR(moments.force, force / count / 3, 0.003);
    EXPECT_NEAR(moments.expected_squares(kStd * kStd), smaller / smaller_count, 0.012);
  }
}

/// A kernel much narrower than the noise: w s is c^2 for nearly all errors with Geman-McClure's c^4 / s, and
/// c sqrt(s) with Huber's.
TEST(KernelMoments, resolve_narrow_kernels) {
  for (const double scale : {0.1, 0.01, 1e-4, 1e-9}) {
    const KernelMoments huber = kernel_moments(RobustKernel::huber, scale, 2, kNoLimit);
    const double mean_length = std::sqrt(std::acos(-1.0) / 2);  // of a standard normal vector in the plane
    EXPECT_NEAR(huber.squares / scale, mean_length, 0.02 * scale + 2e-3);
    EXPECT_NEAR(huber.force / (scale * scale / 2), 1, scale * scale + 2e-3);
    const KernelMoments geman = kernel_moments(RobustKernel::geman_mcclure, scale, 2, kNoLimit);
    // integral of c^4 / (c^2 + s)^2 exp(-s / 2) / 2 ds is c^2 / 2 for a small c
    EXPECT_NEAR(geman.weight / (scale * scale / 2), 1, 4 * scale + 1e-3);
  }
}

}  // namespace
}  // namespace cairn
