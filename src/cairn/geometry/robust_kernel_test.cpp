// SPDX-License-Identifier: Apache-2.0
#include "cairn/geometry/robust_kernel.h"

#include <gtest/gtest.h>

#include <cmath>

namespace cairn {
namespace {

constexpr RobustKernel kAll[] = {RobustKernel::none, RobustKernel::huber, RobustKernel::cauchy,
                                 RobustKernel::geman_mcclure};

TEST(RobustKernel, weight_is_the_derivative_of_the_cost) {
  for (const RobustKernel kernel : kAll) {
    for (const double s : {0.01, 0.5, 3.0, 30.0, 1e4}) {
      const double h = 1e-6 * s, scale = 1.7;
      const double slope = (kernel_cost(kernel, scale, s + h) - kernel_cost(kernel, scale, s - h)) / (2 * h);
      EXPECT_NEAR(kernel_weight(kernel, scale, s), slope, 1e-6) << static_cast<int>(kernel) << " " << s;
    }
  }
}

TEST(RobustKernel, small_residuals_cost_their_square_and_large_ones_less) {
  for (const RobustKernel kernel : kAll) {
    EXPECT_EQ(kernel_cost(kernel, 2.0, 0.0), 0.0);
    EXPECT_EQ(kernel_weight(kernel, 2.0, 0.0), 1.0);
    EXPECT_NEAR(kernel_cost(kernel, 2.0, 1e-6), 1e-6, 1e-11);
    EXPECT_LE(kernel_cost(kernel, 2.0, 1e4), 1e4);
  }
  EXPECT_LE(kernel_cost(RobustKernel::geman_mcclure, 2.0, 1e9), 4.0);
}

}  // namespace
}  // namespace cairn
