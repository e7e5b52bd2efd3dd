// SPDX-License-Identifier: Apache-2.0
#include "cairn/evaluate/chi_square.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "cairn/core/error.h"
#include "cairn/geometry/inlier_limits.h"

namespace cairn {
namespace {

struct Quantile {
  double degrees_of_freedom, probability, value;
};

/// Printed by chi_square_reference.py.
constexpr Quantile kQuantiles[] = {
    {1, 1e-10, 1.5707963267948966e-20}, {1, 0.025, 0.00098206911717525591}, {1, 0.5, 0.45493642311957275},
    {1, 0.68, 0.98894648147802307},     {1, 0.95, 3.8414588206941260},      {1, 0.975, 5.0238861873148890},
    {1, 0.999, 10.827566170662732},     {2, 1e-10, 2.0000000001000000e-10}, {2, 0.025, 0.050635615968579751},
    {2, 0.5, 1.3862943611198906},       {2, 0.68, 2.2788685663767296},      {2, 0.95, 5.9914645471079820},
    {2, 0.975, 7.3777589082278726},     {2, 0.999, 13.815510557964274},     {3, 1e-10, 5.2093976214344802e-7},
    {3, 0.025, 0.21579528262389787},    {3, 0.5, 2.3659738843753383},       {3, 0.68, 3.5058823557681825},
    {3, 0.95, 7.8147279032511800},      {3, 0.975, 9.3484036044961478},     {3, 0.999, 16.266236196238131},
    {6, 1e-10, 0.0016872211249694549},  {6, 0.025, 1.2373442457912026},     {6, 0.5, 5.3481206274471206},
    {6, 0.68, 7.0091699469506022},      {6, 0.95, 12.591587243743979},      {6, 0.975, 14.449375335447922},
    {6, 0.999, 22.457744484825325},     {59, 1e-10, 13.557866359205590},    {59, 0.025, 39.661859351515656},
    {59, 0.5, 58.334689146437072},      {59, 0.68, 63.528387073455577},     {59, 0.95, 77.930523805230422},
    {59, 0.975, 82.117405940238304},    {59, 0.999, 98.324234134741608},    {60, 1e-10, 14.001023400703669},
    {60, 0.025, 40.481748042841830},    {60, 0.5, 59.334666276442463},      {60, 0.68, 64.571513742086712},
    {60, 0.95, 79.081944487848730},     {60, 0.975, 83.297674877173192},    {60, 0.999, 99.607233069849377},
    {61, 1e-10, 14.448304131068842},    {61, 0.025, 41.303137877306475},    {61, 0.5, 60.334644165112308},
    {61, 0.68, 65.614278507766244},     {61, 0.95, 80.232097848762716},     {61, 0.975, 84.476437442809071},
    {61, 0.999, 100.88788530685829},    {300, 1e-10, 169.43559720756681},   {300, 0.025, 253.91232260248973},
    {300, 0.5, 299.33359734921804},     {300, 0.68, 310.92124038063092},    {300, 0.95, 341.39511210876875},
    {300, 0.975, 349.87446882991527},   {300, 0.999, 381.42524852041154},   {1001, 1e-10, 742.12615422288667},
    {1001, 0.025, 915.21333122044130},  {1001, 0.5, 1000.3334123243323},    {1001, 0.68, 1021.3979370303571},
    {1001, 0.95, 1075.7162285460292},   {1001, 0.975, 1090.5747358987630},  {1001, 0.999, 1144.9861668100878},
};

TEST(ChiSquare, InlierLimitsAreQuantiles) {
  EXPECT_NEAR(chi_square_quantile(0.95, 1), kInlierLimit1, 5e-4);
  EXPECT_NEAR(chi_square_quantile(0.95, 2), kInlierLimit2, 5e-4);
  EXPECT_NEAR(chi_square_quantile(0.95, 3), kInlierLimit3, 5e-4);
  EXPECT_NEAR(std::sqrt(chi_square_quantile(0.95, 2)), kInlierScale2, 5e-4);
}

TEST(ChiSquare, QuantilesAreThoseOfSixtyDigits) {
  for (const auto& [degrees, probability, value] : kQuantiles) {
    SCOPED_TRACE(testing::Message() << degrees << " degrees of freedom, " << probability);
    EXPECT_NEAR(chi_square_quantile(probability, degrees) / value, 1, 2e-13);
    EXPECT_NEAR(chi_square_probability(value, degrees), probability, 1e-13);
  }
}

TEST(ChiSquare, QuantilesInvertTheProbability) {
  for (const double degrees : {1.0, 2.0, 6.0, 61.0, 1e4, 1e6, 1e9}) {
    for (const double probability : {1e-100, 1e-6, 0.3, 0.5, 0.7, 1 - 1e-6, 1 - 1e-12}) {
      const double value = chi_square_quantile(probability, degrees);
      EXPECT_NEAR(chi_square_probability(value, degrees), probability, 1e-10)
          << degrees << " " << probability;
    }
  }
}

TEST(ChiSquare, EndsAtZeroAndOne) {
  EXPECT_EQ(chi_square_probability(-1, 3), 0);
  EXPECT_EQ(chi_square_probability(0, 3), 0);
  EXPECT_EQ(chi_square_probability(1e6, 3), 1);
  EXPECT_EQ(chi_square_probability(std::numeric_limits<double>::infinity(), 3), 1);
  EXPECT_NEAR(chi_square_probability(1, 2), 1 - std::exp(-0.5), 1e-16);
  EXPECT_NEAR(chi_square_probability(1, 1), std::erf(std::sqrt(0.5)), 1e-15);
}

TEST(ChiSquare, RefusesWhatHasNoMeaning) {
  EXPECT_THROW((void)chi_square_quantile(0, 3), PreconditionError);
  EXPECT_THROW((void)chi_square_quantile(1, 3), PreconditionError);
  EXPECT_THROW((void)chi_square_quantile(0.5, 0), PreconditionError);
  EXPECT_THROW((void)chi_square_probability(std::nan(""), 3), PreconditionError);
  EXPECT_THROW((void)chi_square_probability(1, std::nan("")), PreconditionError);
}

}  // namespace
}  // namespace cairn
