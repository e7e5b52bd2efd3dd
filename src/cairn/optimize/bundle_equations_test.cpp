// SPDX-License-Identifier: Apache-2.0
#include "cairn/optimize/bundle_equations.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "cairn/core/executor.h"
#include "cairn/geometry/pose_equations.h"
#include "cairn/testing/optimize/bundle_scene.h"

namespace cairn {
namespace {

using testkit::make_bundle_scene;

/// The damped normal equations written out, all unknowns at once, with observation_jacobian.
struct FullEquations {
  Eigen::MatrixXd hessian;
  Eigen::VectorXd gradient;

  explicit FullEquations(Eigen::Index size)
      : hessian(Eigen::MatrixXd::Zero(size, size)), gradient(Eigen::VectorXd::Zero(size)) {}

  void add(const BundleProblem& problem, const BundleObservation& observation, Eigen::Index camera_at,
           Eigen::Index point_at) {
    const Rigid3& pose = problem.camera_from_world[static_cast<std::size_t>(observation.camera)];
    const Eigen::Vector3d in_camera =
        pose * problem.points_in_world[static_cast<std::size_t>(observation.point)];
    const BundleTerm term = make_term(observation);
    const Eigen::Vector3d error = problem.rig.project(in_camera) - term.seen;
    Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(3, gradient.size());
    if (camera_at >= 0) jacobian.middleCols<6>(camera_at) = observation_jacobian(problem.rig, in_camera);
    jacobian.middleCols<3>(point_at) = problem.rig.projection_jacobian(in_camera) * pose.matrix3();
    const double squared = error.dot(term.inverse_variances.cwiseProduct(error));
    const BundleOptions options;
    const Eigen::Vector3d weights =
        kernel_weight(options.kernel, options.kernel_scale, squared) * term.inverse_variances;
    hessian += jacobian.transpose() * weights.asDiagonal() * jacobian;
    gradient += jacobian.transpose() * weights.cwiseProduct(error);
  }
};

TEST(BundleEquations, take_the_step_of_the_full_normal_equations) {
  const BundleProblem problem =
      make_bundle_scene(1, {.cameras = 5, .points = 30, .disparity_share = 0.6}).problem;
  const BundleStructure structure = analyse_bundle(problem);
  const BundleOptions options;
  const Executor executor;
  BundleEquations equations(problem.rig, structure, options, executor);
  BundleState from(problem, structure), to(problem, structure);
  constexpr double kLambda = 0.01;
  equations.evaluate_costs(from);
  equations.build(from, kLambda);
  ASSERT_TRUE(equations.solve());
  equations.move(from, to);

  const Eigen::Index first_point = 6 * 3;
  FullEquations full(first_point + 3 * 30);
  for (const auto& observation : problem.observations)
    full.add(problem, observation, observation.camera < 2 ? -1 : 6 * (observation.camera - 2),
             first_point + 3 * observation.point);
  full.hessian.diagonal() *= 1 + kLambda;
  const Eigen::VectorXd step = -full.hessian.llt().solve(full.gradient);
  for (Eigen::Index i = 0; i < 3; ++i) {
    const auto camera = static_cast<std::size_t>(i + 2);
    const Vector6d moved = left_perturbation(from.camera_from_world[camera], to.camera_from_world[camera]);
    EXPECT_LT((moved - step.segment<6>(6 * i)).norm(), 1e-9) << camera;
  }
  for (std::size_t j = 0; j < 30; ++j) {
    const Eigen::Vector3d moved = to.points[j] - from.points[j];
    EXPECT_LT((moved - step.segment<3>(first_point + 3 * structure.points[j])).norm(), 1e-9) << j;
  }
}

TEST(TermExpansion, has_the_gradient_of_the_cost) {
  const Rig rig{525, 520, 319.5, 239.5, 0.12};
  const Eigen::Vector3d point(0.4, -0.7, 2.3);
  const BundleOptions options{.kernel = RobustKernel::cauchy, .kernel_scale = 3};
  for (const double disparity : {26.0, std::numeric_limits<double>::quiet_NaN()}) {
    const BundleTerm term = make_term({0, 0, {412, 83, disparity, 0.7, 0.5}});
    const auto cost = [&](const Eigen::Vector3d& p) {
      const Eigen::Vector3d error = rig.project(p) - term.seen;
      return 0.5 * kernel_cost(options.kernel, options.kernel_scale,
                               error.dot(term.inverse_variances.cwiseProduct(error)));
    };
    const TermExpansion expansion(rig, point, term, options.kernel, options.kernel_scale);
    const Eigen::Vector3d gradient = expansion.gradient();
    constexpr double kStep = 1e-6;
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d step = kStep * Eigen::Vector3d::Unit(i);
      EXPECT_NEAR((cost(point + step) - cost(point - step)) / (2 * kStep), gradient[i],
                  1e-5 * gradient.norm());
    }
  }
}

TEST(TermExpansion, multiplies_by_the_projection_jacobian) {
  const Rig rig{525, 520, 319.5, 239.5, 0.12};
  const Eigen::Vector3d point(0.4, -0.7, 2.3);
  const BundleTerm term = make_term({0, 0, {412, 83, 26, 0.7, 0.5}});
  const TermExpansion expansion(rig, point, term, RobustKernel::none, 1);
  const Eigen::Matrix3d dense = rig.projection_jacobian(point);
  const Eigen::Matrix3d m = rotation_exp({0.3, 0.7, -1.1}).toRotationMatrix();
  const auto near = [](const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
    return (a - b).norm() < 1e-12 * b.norm();
  };
  EXPECT_TRUE(near(expansion.jacobian_times(m), dense * m));
  EXPECT_TRUE(near(expansion.transposed_times(m), dense.transpose() * m));
  EXPECT_TRUE(near(expansion.hessian(), dense.transpose() * term.inverse_variances.asDiagonal() * dense));
}

TEST(PointSums, tell_which_points_are_determined) {
  const auto is_determined = [](const Eigen::Matrix3d& information) {
    return PointSums{information, Eigen::Vector3d::Zero()}.determine_point();
  };
  const Eigen::Matrix3d across = Eigen::Vector3d(1, 1, 0).asDiagonal();
  EXPECT_FALSE(is_determined(Eigen::Matrix3d::Zero()));
  EXPECT_FALSE(is_determined(across));
  Eigen::Matrix3d along = across;
  along(2, 2) = 1e-6;  // a disparity at a thousand baselines
  EXPECT_TRUE(is_determined(along));
  EXPECT_TRUE(is_determined(1e-12 * along));
  const Eigen::Matrix3d turned = rotation_exp({0.3, 0.7, -1.1}).toRotationMatrix();
  EXPECT_FALSE(is_determined(turned * across * turned.transpose()));
  EXPECT_TRUE(is_determined(turned * along * turned.transpose()));
}

}  // namespace
}  // namespace cairn
