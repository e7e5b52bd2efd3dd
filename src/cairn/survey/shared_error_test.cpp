// SPDX-License-Identifier: Apache-2.0
#include "cairn/survey/shared_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "cairn/core/random.h"

namespace cairn {
namespace {

/// Landmarks whose halves have errors of their own, of that share of the observations' variance.
SharedErrorModel model_of(double share, int landmarks, double outliers = 0) {
  Random random(8);
  SharedErrorModel model;
  for (int i = 0; i < landmarks; ++i) {
    const int observations = 8 + static_cast<int>(random.index(9));
    const double factor = 1 + share * observations / 2;
    double squares = 0;
    for (int k = 0; k < 3; ++k) squares += factor * std::pow(random.normal(), 2);
    if (random.uniform(0, 1) < outliers) squares *= 100;
    model.add(squares / 3, observations);
  }
  return model;
}

TEST(SharedError, is_none_of_independent_observations) {
  EXPECT_LT(model_of(0, 20000).share(), 0.01);
}

TEST(SharedError, is_found_from_halves) {
  EXPECT_NEAR(model_of(0.2, 20000).share(), 0.2, 0.02);
  EXPECT_NEAR(model_of(0.2, 20000).factor(10), 3, 0.2);
}

TEST(SharedError, is_hardly_moved_by_outliers) {
  EXPECT_NEAR(model_of(0.2, 20000, 0.02).share(), 0.2, 0.06);
}

TEST(SharedError, is_not_known_from_a_few) {
  EXPECT_EQ(model_of(0.5, 99).share(), 0);
  EXPECT_GT(model_of(0.5, 100).share(), 0);
}

TEST(SharedError, ignores_what_is_no_difference) {
  SharedErrorModel model = model_of(0.2, 200);
  const double share = model.share();
  for (const double none :
       {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    model.add(none, 10);
  EXPECT_EQ(model.share(), share);
  EXPECT_EQ(SharedErrorModel(model.sums()).share(), share);
}

}  // namespace
}  // namespace cairn
