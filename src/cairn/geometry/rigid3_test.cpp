// SPDX-License-Identifier: Apache-2.0
#include "cairn/geometry/rigid3.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "cairn/core/random.h"

namespace cairn {
namespace {

constexpr double kPi = std::numbers::pi;

Eigen::Vector3d random_vector(Random& random, double size) {
  return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}

Eigen::Vector3d random_direction(Random& random) {
  return Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized();
}

Rigid3 random_transform(Random& random) {
  return {rotation_exp(random_direction(random) * random.uniform(0, kPi)), random_vector(random, 10)};
}

double distance(const Rigid3& a, const Rigid3& b) {
  return motion_norm(a.inverse() * b);
}

class Rigid3Test : public testing::Test {
 protected:
  static constexpr int kTrials = 200;
  Random random_{20};
};

TEST_F(Rigid3Test, inverse_undoes_it) {
  for (int i = 0; i < kTrials; ++i) {
    const Rigid3 a_from_b = random_transform(random_);
    const Eigen::Vector3d point_in_b = random_vector(random_, 10);
    EXPECT_LT((a_from_b.inverse() * (a_from_b * point_in_b) - point_in_b).norm(), 1e-13 * 30);
    EXPECT_LT(distance(a_from_b * a_from_b.inverse(), Rigid3{}), 1e-13);
  }
}

TEST_F(Rigid3Test, composition_is_application_one_after_the_other) {
  for (int i = 0; i < kTrials; ++i) {
    const Rigid3 a_from_b = random_transform(random_), b_from_c = random_transform(random_);
    const Rigid3 c_from_d = random_transform(random_);
    const Eigen::Vector3d point_in_c = random_vector(random_, 10);
    EXPECT_LT(((a_from_b * b_from_c) * point_in_c - a_from_b * (b_from_c * point_in_c)).norm(), 1e-12);
    EXPECT_LT(distance((a_from_b * b_from_c) * c_from_d, a_from_b * (b_from_c * c_from_d)), 1e-12);
  }
}

TEST_F(Rigid3Test, a_long_chain_stays_a_rotation) {
  Rigid3 chain;
  const Rigid3 step = random_transform(random_);
  for (int i = 0; i < 100'000; ++i) chain = chain * step;
  EXPECT_NEAR(chain.rotation.norm(), 1.0, 1e-12);
}

TEST_F(Rigid3Test, matrix_acts_as_the_quaternion) {
  const Rigid3 a_from_b = random_transform(random_);
  const Eigen::Vector3d point_in_b = random_vector(random_, 1);
  EXPECT_LT((a_from_b.matrix3() * point_in_b - a_from_b.rotation * point_in_b).norm(), 1e-14);
}

TEST(RotationExp, turns_about_the_axis_by_the_angle) {
  const Eigen::Vector3d turned = rotation_exp({0, 0, kPi / 2}) * Eigen::Vector3d(1, 0, 0);
  EXPECT_LT((turned - Eigen::Vector3d(0, 1, 0)).norm(), 1e-15);
}

/// All sizes of angle, with the borders of the series (1e-4, 1e-5) and of the range (pi) among them.
TEST_F(Rigid3Test, log_is_the_inverse_of_exp) {
  const std::vector<double> angles = {0,       1e-300,     1e-12,      9.9e-6,     1.01e-5, 2e-5,
                                      9.99e-5, 1.001e-4,   1e-3,       0.1,        1,       2,
                                      3,       kPi - 1e-3, kPi - 1e-7, kPi - 1e-10};
  for (const double angle : angles) {
    const Eigen::Vector3d vector = angle * random_direction(random_);
    const Eigen::Quaterniond rotation = rotation_exp(vector);
    EXPECT_NEAR(rotation.norm(), 1.0, 1e-15);
    EXPECT_LT((rotation_log(rotation) - vector).norm(), 1e-15 + 1e-14 * angle) << angle;
    EXPECT_NEAR(rotation_angle(rotation), angle, 1e-15 + 1e-14 * angle);
  }
}

TEST_F(Rigid3Test, log_does_not_see_the_sign_of_the_quaternion) {
  for (int i = 0; i < kTrials; ++i) {
    const Eigen::Quaterniond rotation = random_transform(random_).rotation;
    const Eigen::Quaterniond negated(-rotation.coeffs());
    EXPECT_EQ(rotation_log(rotation), rotation_log(negated));
    EXPECT_LE(rotation_log(rotation).norm(), kPi);
    EXPECT_EQ(rotation_angle(rotation), rotation_angle(negated));
  }
}

/// d(exp(w) R p + ...)/dxi at 0 is [-skew(R p + t), I]: what all residuals build on.
TEST_F(Rigid3Test, left_perturbation_has_the_derivative_that_solvers_use) {
  constexpr double kStep = 1e-6;
  const Rigid3 a_from_b = random_transform(random_);
  const Eigen::Vector3d point_in_b = random_vector(random_, 3);
  Eigen::Matrix<double, 3, 6> expected;
  expected << -skew(a_from_b * point_in_b), Eigen::Matrix3d::Identity();
  for (int k = 0; k < 6; ++k) {
    const Vector6d xi = kStep * Vector6d::Unit(k);
    const Eigen::Vector3d slope =
        (perturb_left(xi, a_from_b) * point_in_b - perturb_left(-xi, a_from_b) * point_in_b) / (2 * kStep);
    EXPECT_LT((slope - expected.col(k)).norm(), 1e-8) << k;
  }
}

TEST_F(Rigid3Test, no_perturbation_changes_nothing) {
  const Rigid3 a_from_b = random_transform(random_);
  EXPECT_LT(distance(perturb_left(Vector6d::Zero(), a_from_b), a_from_b), 1e-15);
}

TEST_F(Rigid3Test, left_perturbation_is_found_again) {
  const Rigid3 a_from_b = random_transform(random_);
  Vector6d xi;
  xi << 0.3, -1.2, 0.7, 4, -5, 6;
  EXPECT_LT((left_perturbation(a_from_b, perturb_left(xi, a_from_b)) - xi).norm(), 1e-13);
  EXPECT_LT(left_perturbation(a_from_b, a_from_b).norm(), 1e-14);
}

TEST_F(Rigid3Test, skew_is_the_cross_product) {
  const Eigen::Vector3d a = random_vector(random_, 1), b = random_vector(random_, 1);
  EXPECT_LT((skew(a) * b - a.cross(b)).norm(), 1e-16);
}

TEST(MotionNorm, adds_angle_and_distance) {
  EXPECT_NEAR(motion_norm({rotation_exp({0.3, 0, 0}), {0, 3, 4}}), 5.3, 1e-14);
}

TEST(NearestRotation, undoes_small_errors) {
  const Eigen::Quaterniond rotation = rotation_exp({0.3, -0.2, 0.9});
  Eigen::Matrix3d matrix = rotation.toRotationMatrix();
  EXPECT_LT(deviation_from_rotation(matrix), 1e-15);
  matrix(0, 1) += 1e-4;
  EXPECT_GT(deviation_from_rotation(matrix), 1e-5);
  EXPECT_LT(deviation_from_rotation(matrix), 1e-3);
  EXPECT_LT(rotation_angle(rotation.conjugate() * nearest_rotation(matrix)), 1e-4);
  EXPECT_LT(deviation_from_rotation(nearest_rotation(matrix).toRotationMatrix()), 1e-15);
}

TEST(NearestRotation, mirrors_and_numbers_that_are_none_are_far_from_rotations) {
  EXPECT_EQ(deviation_from_rotation(-Eigen::Matrix3d::Identity()), std::numeric_limits<double>::infinity());
  EXPECT_EQ(deviation_from_rotation(Eigen::Matrix3d::Constant(std::numeric_limits<double>::quiet_NaN())),
            std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace cairn
