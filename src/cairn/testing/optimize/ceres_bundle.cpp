// SPDX-License-Identifier: Apache-2.0
#include "cairn/testing/optimize/ceres_bundle.h"

#include <ceres/ceres.h>

#include <Eigen/Geometry>
#include <memory>

#include "cairn/geometry/pose_equations.h"

namespace cairn::testkit {

namespace {

Rigid3 pose_of(const double* block) {
  return {Eigen::Quaterniond(Eigen::Map<const Eigen::Vector4d>(block)),
          Eigen::Map<const Eigen::Vector3d>(block + 4)};
}

/// perturb_left. Costs give their derivative by xi in the first six columns, and PlusJacobian is the
/// identity over a row of zeros.
class PoseManifold : public ceres::Manifold {
 public:
  [[nodiscard]] int AmbientSize() const override { return 7; }
  [[nodiscard]] int TangentSize() const override { return 6; }
  bool Plus(const double* block, const double* xi, double* moved) const override {
    const Rigid3 pose = perturb_left(Eigen::Map<const Vector6d>(xi), pose_of(block));
    Eigen::Map<Eigen::Vector4d>{moved} = pose.rotation.coeffs();
    Eigen::Map<Eigen::Vector3d>{moved + 4} = pose.translation;
    return true;
  }
  bool PlusJacobian(const double* /*block*/, double* jacobian) const override {
    Eigen::Map<Eigen::Matrix<double, 7, 6, Eigen::RowMajor>>{jacobian}.setIdentity();
    return true;
  }
  bool Minus(const double* moved, const double* block, double* xi) const override {
    Eigen::Map<Vector6d>{xi} = left_perturbation(pose_of(block), pose_of(moved));
    return true;
  }
  bool MinusJacobian(const double* /*block*/, double* jacobian) const override {
    Eigen::Map<Eigen::Matrix<double, 6, 7, Eigen::RowMajor>>{jacobian}.setIdentity();
    return true;
  }
};

template <int kRows>
class Cost : public ceres::SizedCostFunction<kRows, 7, 3> {
 public:
  Cost(const Rig& rig, const Observation& seen)
      : rig_(rig),
        seen_(seen.u, seen.v, seen.has_disparity() ? seen.d : 0.0),
        whitening_(inverse_variances(seen).cwiseSqrt()) {}

  bool Evaluate(double const* const* blocks, double* residual, double** jacobians) const override {
    const Rigid3 pose = pose_of(blocks[0]);
    const Eigen::Vector3d in_camera = pose * Eigen::Map<const Eigen::Vector3d>(blocks[1]);
    const Eigen::Vector3d error = whitening_.cwiseProduct(rig_.project(in_camera) - seen_);
    Eigen::Map<Eigen::Matrix<double, kRows, 1>>{residual} = error.head<kRows>();
    if (jacobians == nullptr) return true;
    if (jacobians[0] != nullptr) {
      Eigen::Map<Eigen::Matrix<double, kRows, 7, Eigen::RowMajor>> by_camera(jacobians[0]);
      by_camera.template leftCols<6>() =
          (whitening_.asDiagonal() * observation_jacobian(rig_, in_camera)).template topRows<kRows>();
      by_camera.col(6).setZero();
    }
    if (jacobians[1] != nullptr)
      Eigen::Map<Eigen::Matrix<double, kRows, 3, Eigen::RowMajor>>{jacobians[1]} =
          (whitening_.asDiagonal() * rig_.projection_jacobian(in_camera) * pose.matrix3())
              .template topRows<kRows>();
    return true;
  }

 private:
  Rig rig_;
  Eigen::Vector3d seen_, whitening_;
};

ceres::CostFunction* make_cost(const Rig& rig, const Observation& seen) {
  if (seen.has_disparity()) return new Cost<3>(rig, seen);
  return new Cost<2>(rig, seen);
}

ceres::Solver::Options solver_options(const BundleOptions& options, CeresBundle::Schur type) {
  ceres::Solver::Options result;
  result.linear_solver_type = type == CeresBundle::Schur::dense ? ceres::DENSE_SCHUR : ceres::SPARSE_SCHUR;
  result.num_threads = 1;
  result.max_num_iterations = options.max_iterations;
  result.function_tolerance = options.converged_relative_cost;
  result.gradient_tolerance = 1e-14;
  result.parameter_tolerance = 1e-14;
  result.logging_type = ceres::SILENT;
  result.linear_solver_ordering = std::make_shared<ceres::ParameterBlockOrdering>();
  return result;
}

ceres::Problem::Options problem_options() {
  ceres::Problem::Options options;
  options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  return options;
}

}  // namespace

CeresBundle::CeresBundle(const BundleProblem& problem)
    : problem_(&problem), points_(problem.points_in_world) {
  for (const Rigid3& pose : problem.camera_from_world) {
    Pose& block = cameras_.emplace_back();
    Eigen::Map<Eigen::Vector4d>{block.data()} = pose.rotation.coeffs();
    Eigen::Map<Eigen::Vector3d>{block.data() + 4} = pose.translation;
  }
}

CeresBundle::Costs CeresBundle::solve(const BundleOptions& options, Schur type) {
  ceres::Problem problem(problem_options());
  ceres::Solver::Options solver = solver_options(options, type);
  ceres::HuberLoss huber(options.kernel_scale);
  PoseManifold manifold;
  for (const BundleObservation& observation : problem_->observations) {
    double* camera = cameras_[static_cast<std::size_t>(observation.camera)].data();
    double* point = points_[static_cast<std::size_t>(observation.point)].data();
    problem.AddResidualBlock(make_cost(problem_->rig, observation.seen),
                             options.kernel == RobustKernel::huber ? &huber : nullptr, camera, point);
    solver.linear_solver_ordering->AddElementToGroup(point, 0);
    solver.linear_solver_ordering->AddElementToGroup(camera, 1);
  }
  for (std::size_t i = 0; i < cameras_.size(); ++i) {
    if (!problem.HasParameterBlock(cameras_[i].data())) continue;
    problem.SetManifold(cameras_[i].data(), &manifold);
    if (problem_->camera_fixed[i] != 0) problem.SetParameterBlockConstant(cameras_[i].data());
  }
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &problem, &summary);
  return {summary.initial_cost, summary.final_cost};
}

Rigid3 CeresBundle::camera_from_world(std::size_t camera) const {
  return pose_of(cameras_[camera].data());
}

}  // namespace cairn::testkit
