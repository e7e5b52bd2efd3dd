// SPDX-License-Identifier: Apache-2.0
#include "cairn/evaluate/consistency.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <vector>

#include "cairn/core/error.h"
#include "cairn/core/random.h"
#include "cairn/geometry/rigid3.h"

namespace cairn {
namespace {

Eigen::VectorXd random_vector(Random& random, int size) {
  Eigen::VectorXd vector(size);
  for (auto& value : vector) value = random.normal();
  return vector;
}

/// Correlated, with sigmas from a thousandth to ten.
Eigen::MatrixXd random_covariance(Random& random, int size) {
  Eigen::MatrixXd root(size, size);
  for (auto& value : root.reshaped()) value = random.normal();
  Eigen::VectorXd sigmas(size);
  for (auto& value : sigmas) value = std::pow(10.0, random.uniform(-3, 1));
  return sigmas.asDiagonal() * (root * root.transpose() + 0.1 * Eigen::MatrixXd::Identity(size, size)) *
         sigmas.asDiagonal();
}

/// NEES of errors whose covariance is `stretch` times the stated one.
ConsistencyReport simulate(int size, double stretch, std::size_t count) {
  Random random(7, static_cast<std::uint64_t>(size));
  std::vector<double> nees;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::MatrixXd stated = random_covariance(random, size);
    const Eigen::MatrixXd root = stated.llt().matrixL();
    const Eigen::VectorXd error = std::sqrt(stretch) * (root * random_vector(random, size));
    nees.push_back(normalized_error_squared(error, stated).value());
  }
  return assess_consistency(nees, size).value();
}

TEST(Consistency, NormalizesByTheCovariance) {
  Eigen::Matrix2d covariance;
  covariance << 4, 1, 1, 9;
  const Eigen::Vector2d error(2, -3);
  EXPECT_NEAR(normalized_error_squared(error, covariance).value(), error.dot(covariance.inverse() * error),
              1e-14);
  EXPECT_EQ(normalized_error_squared(Eigen::Vector2d::Zero(), covariance).value(), 0);
}

TEST(Consistency, DoesNotDependOnUnits) {
  Random random(3);
  const Eigen::MatrixXd covariance = random_covariance(random, 6);
  const Eigen::VectorXd error = random_vector(random, 6);
  Eigen::VectorXd units(6);
  units << 1e-8, 1e8, 1, 1e-3, 1e3, 57;
  const double expected = normalized_error_squared(error, covariance).value();
  const Eigen::MatrixXd in_units = units.asDiagonal() * covariance * units.asDiagonal();
  EXPECT_NEAR(normalized_error_squared(units.cwiseProduct(error), in_units).value() / expected, 1, 1e-9);
}

TEST(Consistency, SaysWhatIsNoCovariance) {
  const Eigen::Vector2d error(1, 1);
  const auto with = [&](double xx, double xy, double yx, double yy) {
    Eigen::Matrix2d covariance;
    covariance << xx, xy, yx, yy;
    return normalized_error_squared(error, covariance);
  };
  EXPECT_TRUE(with(1, 0.5, 0.5, 1));
  EXPECT_TRUE(with(1e-20, 0, 0, 1e20));
  EXPECT_FALSE(with(1, 1, 1, 1));      // of rank 1
  EXPECT_FALSE(with(1, 2, 2, 1));      // indefinite
  EXPECT_FALSE(with(1, 0.5, 0.4, 1));  // not symmetric
  EXPECT_FALSE(with(1, 0, 0, 0));
  EXPECT_FALSE(with(-1, 0, 0, -1));
  EXPECT_FALSE(with(1, 0, 0, std::nan("")));
  EXPECT_FALSE(with(1, 0, 0, HUGE_VAL));
  EXPECT_FALSE(normalized_error_squared(Eigen::Vector2d(std::nan(""), 0), Eigen::Matrix2d::Identity()));
  EXPECT_THROW((void)normalized_error_squared(error, Eigen::Matrix3d::Identity()), PreconditionError);
}

TEST(Consistency, FindsHonestCovariancesHonest) {
  for (const int size : {1, 3, 6}) {
    const ConsistencyReport report = simulate(size, 1, 4000);
    EXPECT_EQ(report.count, 4000U);
    EXPECT_EQ(report.degrees_of_freedom, size);
    EXPECT_EQ(report.verdict, CovarianceVerdict::honest) << report.mean_nees;
    for (const Coverage& coverage : report.coverage)
      EXPECT_LT(std::abs(coverage.actual - coverage.nominal), 3 * coverage.standard_error);
    EXPECT_NEAR(report.median_ratio(), 1, 0.08);
    EXPECT_NEAR(report.mean_nees, size, 0.05 * size);
  }
}

TEST(Consistency, FindsLiarsOut) {
  const ConsistencyReport bold = simulate(3, 1.5, 1000), shy = simulate(3, 0.7, 1000);
  EXPECT_EQ(bold.verdict, CovarianceVerdict::overconfident);
  EXPECT_LT(bold.coverage[2].actual, 0.93);
  EXPECT_EQ(shy.verdict, CovarianceVerdict::pessimistic);
  EXPECT_GT(shy.coverage[1].actual, 0.75);
}

/// 2.5 % and 97.5 % of chi-square with 100 degrees of freedom are 74.222 and 129.561 in any table.
TEST(Consistency, BoundsTheMeanByTheChiSquareOfTheSum) {
  const ConsistencyReport report = assess_consistency(std::vector<double>(50, 2.0), 2).value();
  EXPECT_NEAR(report.mean_nees_low, 74.222 / 50, 1e-5);
  EXPECT_NEAR(report.mean_nees_high, 129.561 / 50, 1e-5);
  EXPECT_EQ(report.coverage[0].inside, 0U);   // half lie below 1.386
  EXPECT_EQ(report.coverage[1].inside, 50U);  // 68 % below 2.279
  EXPECT_FALSE(assess_consistency({}, 3));
  EXPECT_THROW((void)assess_consistency(std::vector<double>{1, std::nan("")}, 3), PreconditionError);
  EXPECT_THROW((void)assess_consistency(std::vector<double>{1}, 0), PreconditionError);
}

TEST(Consistency, StatesCoverageAtFourShares) {
  const ConsistencyReport report = simulate(3, 1, 500);
  ASSERT_EQ(report.coverage.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(report.coverage[i].nominal, kNominalShares[i]);
  ASSERT_EQ(report.curve.size(), 101U);
  EXPECT_EQ(report.curve[0], 0);
  EXPECT_EQ(report.curve[50], report.coverage[0].actual);
  EXPECT_EQ(report.curve[68], report.coverage[1].actual);
  EXPECT_EQ(report.curve[95], report.coverage[2].actual);
  EXPECT_EQ(report.curve[100], 1);
}

/// One gross error in a hundred: the mean calls all of them liars, the median does not.
TEST(Consistency, HasAMedianThatGrossErrorsDoNotMove) {
  Random random(5);
  std::vector<double> nees;
  for (int i = 0; i < 1000; ++i) nees.push_back(random_vector(random, 3).squaredNorm());
  for (std::size_t i = 0; i < 10; ++i) nees[i] = 1e6;
  const ConsistencyReport report = assess_consistency(nees, 3).value();
  EXPECT_GT(report.mean_per_freedom(), 1000);
  EXPECT_NEAR(report.median_ratio(), 1, 0.15);
  EXPECT_NEAR(report.expected_median, 2.36597, 1e-5);  // of chi-square with 3 degrees of freedom
}

TEST(ErrorCollector, ComparesStatedDeviationsWithErrors) {
  Random random(9);
  ErrorCollector same, along_one;
  const Eigen::Matrix3d thin = Eigen::Vector3d(4, 1e-8, 1e-8).asDiagonal();
  for (int i = 0; i < 4000; ++i) {
    const Eigen::Vector3d unit = random_vector(random, 3);
    same.add(2 * unit, 4 * Eigen::Matrix3d::Identity());
    along_one.add(thin.cwiseSqrt() * unit, thin);
  }
  EXPECT_NEAR(same.assess()->median_std, 2 * std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(same.assess()->std_per_error(), 1.126, 0.03);
  EXPECT_NEAR(along_one.assess()->std_per_error(), 1.483, 0.05);
  EXPECT_EQ(along_one.assess()->report.degrees_of_freedom, 3);
  EXPECT_NEAR(same.assess()->honest_std_per_error(), std::sqrt(3 / 2.36597), 1e-5);
  EXPECT_NEAR(along_one.assess()->honest_std_per_error(), 1.48260, 1e-4);
}

/// Errors that differ in size and shape: what the ratio has to be is known before it is seen.
TEST(ErrorCollector, KnowsTheRatioOfHonestErrors) {
  Random random(10);
  ErrorCollector errors;
  for (int i = 0; i < 6000; ++i) {
    const Eigen::MatrixXd covariance = random_covariance(random, 3);
    errors.add(Eigen::MatrixXd(covariance.llt().matrixL()) * random_vector(random, 3), covariance);
  }
  EXPECT_GT(errors.assess()->honest_std_per_error(), 1.2);
  EXPECT_NEAR(errors.assess()->std_per_error() / errors.assess()->honest_std_per_error(), 1, 0.06);
}

TEST(ErrorCollector, RefusesWhatIsNoCovariance) {
  ErrorCollector errors;
  EXPECT_FALSE(errors.assess());
  EXPECT_THROW(errors.add(Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero()), PreconditionError);
  errors.add(Eigen::Vector3d::Zero(), Eigen::Matrix3d::Identity());
  EXPECT_THROW(errors.add(Eigen::Vector2d::Zero(), Eigen::Matrix2d::Identity()), PreconditionError);
  EXPECT_EQ(errors.count(), 1U);
  EXPECT_TRUE(is_positive_definite(Eigen::Matrix3d::Identity()));
  EXPECT_FALSE(is_positive_definite(-Eigen::Matrix3d::Identity()));
}

TEST(Consistency, TakesPosesInTheSolversCoordinates) {
  Random random(11);
  const Rigid3 truth{rotation_exp({1, 2, 3}), {10, 20, 30}};
  const Matrix6d covariance = random_covariance(random, 6) * 1e-4;
  const Vector6d error = Eigen::MatrixXd(covariance.llt().matrixL()) * random_vector(random, 6);
  const Rigid3 estimate = perturb_left(error, truth);
  const Vector6d found = left_perturbation(truth, estimate);
  EXPECT_NEAR(normalized_error_squared(found, covariance).value() /
                  normalized_error_squared(error, covariance).value(),
              1, 1e-6);
}

}  // namespace
}  // namespace cairn
