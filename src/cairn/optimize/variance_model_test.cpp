// SPDX-License-Identifier: Apache-2.0
#include "cairn/optimize/variance_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "cairn/core/error.h"
#include "cairn/core/random.h"

namespace cairn {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(Digamma, has_its_known_values) {
  EXPECT_NEAR(digamma(1), -0.577215664901533, 1e-9);  // Euler's constant
  EXPECT_NEAR(digamma(0.5), -0.577215664901533 - 2 * std::log(2), 1e-9);
  EXPECT_NEAR(digamma(10), 2.251752589066721, 1e-9);
  for (const double x : {0.01, 0.7, 3.3, 5.9, 6.1, 40.0})
    EXPECT_NEAR(digamma(x + 1), digamma(x) + 1 / x, 1e-9) << x;
}

TEST(Trigamma, has_its_known_values) {
  EXPECT_NEAR(trigamma(1), kPi * kPi / 6, 1e-9);
  EXPECT_NEAR(trigamma(0.5), kPi * kPi / 2, 1e-9);
  for (const double x : {0.01, 0.7, 3.3, 5.9, 6.1, 40.0})
    EXPECT_NEAR(trigamma(x + 1), trigamma(x) - 1 / (x * x), 1e-9) << x;
}

TEST(Trigamma, is_the_derivative_of_digamma) {
  for (const double x : {0.3, 1.0, 4.5, 25.0})
    EXPECT_NEAR((digamma(x + 1e-4) - digamma(x - 1e-4)) / 2e-4, trigamma(x), 1e-4 * trigamma(x)) << x;
}

TEST(Trigamma, is_undone) {
  for (const double x : {1e-3, 0.5, 2.0, 30.0, 1e5})
    EXPECT_NEAR(inverse_trigamma(trigamma(x)), x, 1e-6 * x) << x;
}

/// Landmarks whose observations' variances have a scaled inverse chi-square distribution.
class Landmarks {
 public:
  explicit Landmarks(const VariancePrior& truth) : truth_(truth) {}
  /// Variance of the next landmark's observations.
  double variance() { return truth_.freedom * truth_.scale / chi_square(static_cast<int>(truth_.freedom)); }
  double chi_square(int freedom) {
    double sum = 0;
    for (int i = 0; i < freedom; ++i) sum += std::pow(random_.normal(), 2);
    return sum;
  }
  /// 2 n - 3 for n = 3 to 6 observations.
  int redundancy() { return 3 + 2 * static_cast<int>(random_.index(4)); }
  double normal() { return random_.normal(); }

 private:
  VariancePrior truth_;
  Random random_{42};
};

TEST(VarianceModel, recovers_the_distribution) {
  for (const VariancePrior truth : {VariancePrior{4, 1}, VariancePrior{6, 1.7}, VariancePrior{12, 0.3}}) {
    Landmarks landmarks(truth);
    VarianceModel model;
    for (int i = 0; i < 100'000; ++i) {
      const int redundancy = landmarks.redundancy();
      const double variance = landmarks.variance();
      model.add(variance * landmarks.chi_square(redundancy), redundancy);
    }
    // Standard errors, from repeated simulations: 1 to 2 % of the freedom, 0.5 % of the scale.
    EXPECT_NEAR(model.prior().freedom, truth.freedom, 0.08 * truth.freedom);
    EXPECT_NEAR(model.prior().scale, truth.scale, 0.02 * truth.scale);
  }
}

TEST(VarianceModel, its_factor_makes_covariances_honest) {
  const VariancePrior truth{5, 1.4};
  Landmarks landmarks(truth);
  constexpr int kCount = 100'000;
  std::vector<double> squares;  // of a coordinate's error, of cofactor 1
  std::vector<double> sums;
  std::vector<int> redundancies;
  VarianceModel model;
  for (int i = 0; i < kCount; ++i) {
    const double variance = landmarks.variance();
    redundancies.push_back(landmarks.redundancy());
    sums.push_back(variance * landmarks.chi_square(redundancies.back()));
    squares.push_back(variance * std::pow(landmarks.normal(), 2));
    model.add(sums.back(), redundancies.back());
  }
  double nees = 0, nees_of_three = 0, of_three = 0;
  for (std::size_t i = 0; i < squares.size(); ++i) {
    const double share = squares[i] / model.prior().factor(sums[i], redundancies[i]);
    nees += share;
    if (redundancies[i] == 3) nees_of_three += share, ++of_three;
  }
  EXPECT_NEAR(nees / kCount, 1, 0.03);
  EXPECT_NEAR(nees_of_three / of_three, 1, 0.05);
}

TEST(VarianceModel, landmarks_that_are_all_alike_have_one_factor) {
  Landmarks landmarks({});
  VarianceModel model;
  for (int i = 0; i < 20'000; ++i) model.add(2.5 * landmarks.chi_square(9), 9);
  EXPECT_GT(model.prior().freedom, 100);
  EXPECT_NEAR(model.prior().scale, 2.5, 0.05);
  EXPECT_NEAR(model.prior().factor(9 * 2.5 * 4, 9), 2.5, 0.75);  // four times the noise is hardly believed
}

TEST(VarianceModel, knows_nothing_from_a_few) {
  VarianceModel model;
  for (int i = 0; i < 99; ++i) model.add(30, 3);
  EXPECT_EQ(model.prior().scale, VariancePrior().scale);
  EXPECT_EQ(model.prior().freedom, VariancePrior().freedom);
  model.add(30, 3);
  EXPECT_GT(model.prior().scale, 5);
}

TEST(VarianceModel, stands_a_fit_without_residuals) {
  VarianceModel model;
  for (int i = 0; i < 200; ++i) model.add(i % 2 == 0 ? 0 : 3, 3);
  EXPECT_TRUE(std::isfinite(model.prior().scale));
  EXPECT_GE(model.prior().freedom, 2.1);
  EXPECT_GT(model.prior().factor(0, 1), 0);
}

TEST(VarianceModel, goes_on_from_its_sums) {
  VarianceModel model;
  for (int i = 0; i < 150; ++i) model.add(1 + i % 7, 3);
  VarianceModel resumed(model.sums());
  model.add(9, 6);
  resumed.add(9, 6);
  EXPECT_EQ(resumed.prior().freedom, model.prior().freedom);
  EXPECT_EQ(resumed.prior().scale, model.prior().scale);
}

TEST(VarianceModel, a_landmark_has_redundancy) {
  EXPECT_THROW(VarianceModel().add(1, 0), PreconditionError);
}

}  // namespace
}  // namespace cairn
