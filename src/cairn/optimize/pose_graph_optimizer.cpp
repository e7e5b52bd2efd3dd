// SPDX-License-Identifier: Apache-2.0
#include "cairn/optimize/pose_graph_optimizer.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <memory>

#include "cairn/core/error.h"
#include "cairn/geometry/decompositions.h"
#include "cairn/optimize/chordal_relaxation.h"
#include "cairn/optimize/pose_graph_residual.h"
#include "cairn/optimize/pose_graph_structure.h"

namespace cairn {
namespace {

/// A pose as Ceres sees it: qx qy qz qw x y z.
using PoseBlock = std::array<double, 7>;

Rigid3 pose_of(const double* block) {
  return {Eigen::Quaterniond(Eigen::Map<const Eigen::Vector4d>(block)),
          Eigen::Map<const Eigen::Vector3d>(block + 4)};
}

void store_pose(const Rigid3& pose, double* block) {
  Eigen::Map<Eigen::Vector4d>{block} = pose.rotation.coeffs();
  Eigen::Map<Eigen::Vector3d>{block + 4} = pose.translation;
}

/// perturb_vertex for Ceres. Ceres only ever uses (Jacobian of the cost by the block) * (PlusJacobian), so
/// EdgeCost gives the Jacobian by xi in the first six columns, and PlusJacobian is the identity over a row of
/// zeros.
class VertexManifold : public ceres::Manifold {
 public:
  [[nodiscard]] int AmbientSize() const override { return 7; }
  [[nodiscard]] int TangentSize() const override { return 6; }

  bool Plus(const double* block, const double* xi, double* moved) const override {
    store_pose(perturb_vertex(Eigen::Map<const Vector6d>(xi), pose_of(block)), moved);
    return true;
  }
  bool PlusJacobian(const double* /*block*/, double* jacobian) const override {
    Eigen::Map<Eigen::Matrix<double, 7, 6, Eigen::RowMajor>>{jacobian}.setIdentity();
    return true;
  }
  bool Minus(const double* moved, const double* block, double* xi) const override {
    const Rigid3 to = pose_of(moved), from = pose_of(block);
    Eigen::Map<Vector6d> step(xi);
    step.head<3>() = rotation_log(to.rotation * from.rotation.conjugate());
    step.tail<3>() = to.translation - from.translation;
    return true;
  }
  bool MinusJacobian(const double* /*block*/, double* jacobian) const override {
    Eigen::Map<Eigen::Matrix<double, 6, 7, Eigen::RowMajor>>{jacobian}.setIdentity();
    return true;
  }
};

/// perturb_vertex within the plane: steps (w_z, v_x, v_y), which are consecutive in xi.
class PlanarManifold : public ceres::Manifold {
 public:
  [[nodiscard]] int AmbientSize() const override { return 7; }
  [[nodiscard]] int TangentSize() const override { return 3; }

  bool Plus(const double* block, const double* step, double* moved) const override {
    Vector6d xi = Vector6d::Zero();
    xi.segment<3>(kFirst) = Eigen::Map<const Eigen::Vector3d>(step);
    store_pose(perturb_vertex(xi, pose_of(block)), moved);
    return true;
  }
  bool PlusJacobian(const double* /*block*/, double* jacobian) const override {
    Eigen::Map<Eigen::Matrix<double, 7, 3, Eigen::RowMajor>> target(jacobian);
    target.setZero();
    target.middleRows<3>(kFirst).setIdentity();
    return true;
  }
  bool Minus(const double* moved, const double* block, double* step) const override {
    const Rigid3 to = pose_of(moved), from = pose_of(block);
    const Eigen::Vector3d shift = to.translation - from.translation;
    Eigen::Map<Eigen::Vector3d>{step} << rotation_log(to.rotation * from.rotation.conjugate()).z(), shift.x(),
        shift.y();
    return true;
  }
  bool MinusJacobian(const double* /*block*/, double* jacobian) const override {
    Eigen::Map<Eigen::Matrix<double, 3, 7, Eigen::RowMajor>> target(jacobian);
    target.setZero();
    target.middleCols<3>(kFirst).setIdentity();
    return true;
  }

 private:
  static constexpr int kFirst = 2;
};

std::unique_ptr<ceres::Manifold> make_manifold(const PoseGraph& graph) {
  if (graph.planar) return std::make_unique<PlanarManifold>();
  return std::make_unique<VertexManifold>();
}

/// The pose of the plane that is left of one which rounding moved out of it.
Rigid3 in_plane(const Rigid3& pose) {
  return {Eigen::Quaterniond(pose.rotation.w(), 0, 0, pose.rotation.z()).normalized(),
          {pose.translation.x(), pose.translation.y(), 0}};
}

/// S with S^T S = information. By eigenvalues, because information may be semi-definite.
Matrix6d square_root(const Matrix6d& information) {
  const SymmetricEigen<6> eigen = eigen_of_symmetric(information);
  return eigen.values.cwiseMax(0.0).cwiseSqrt().asDiagonal() * eigen.vectors.transpose();
}

class EdgeCost : public ceres::SizedCostFunction<6, 7, 7> {
 public:
  EdgeCost(const PoseGraph& graph, const PoseGraph::Edge& edge)
      : graph_(graph), edge_(edge), whitening_(square_root(edge.information)) {}

  bool Evaluate(double const* const* blocks, double* residual, double** jacobians) const override {
    const Rigid3 world_from_a = pose_of(blocks[0]), world_from_b = pose_of(blocks[1]);
    Eigen::Map<Vector6d>{residual} = whitening_ * edge_error(graph_, edge_, world_from_a, world_from_b);
    if (jacobians == nullptr) return true;
    const auto derivatives_of = graph_.planar ? planar_graph_jacobians : pose_graph_jacobians;
    const PoseGraphJacobians derivatives = derivatives_of(world_from_a, world_from_b, edge_.a_from_b);
    store(whitening_ * derivatives.by_a, jacobians[0]);
    store(whitening_ * derivatives.by_b, jacobians[1]);
    return true;
  }

 private:
  static void store(const Matrix6d& by_xi, double* jacobian) {
    if (jacobian == nullptr) return;
    Eigen::Map<Eigen::Matrix<double, 6, 7, Eigen::RowMajor>> target(jacobian);
    target.leftCols<6>() = by_xi;
    target.col(6).setZero();
  }

  const PoseGraph& graph_;
  const PoseGraph::Edge& edge_;
  Matrix6d whitening_;
};

/// rho(s) = c^2 s / (c^2 + s).
class GemanMcClureLoss : public ceres::LossFunction {
 public:
  explicit GemanMcClureLoss(double scale) : c2_(scale * scale) {}
  void Evaluate(double s, double* rho) const override {
    const double share = c2_ / (c2_ + s);
    rho[0] = s * share;
    rho[1] = share * share;
    rho[2] = -2.0 * share * share / (c2_ + s);
  }

 private:
  double c2_;
};

std::unique_ptr<ceres::LossFunction> make_loss(const PoseGraphOptions& options) {
  switch (options.kernel) {
    case RobustKernel::huber:
      return std::make_unique<ceres::HuberLoss>(options.robust_scale);
    case RobustKernel::cauchy:
      return std::make_unique<ceres::CauchyLoss>(options.robust_scale);
    case RobustKernel::geman_mcclure:
      return std::make_unique<GemanMcClureLoss>(options.robust_scale);
    case RobustKernel::none:
      break;
  }
  return nullptr;
}

/// The graph's problem with its parts found; lives as long as one call.
class PoseGraphProblem {
 public:
  PoseGraphProblem(const PoseGraph& graph, const PoseGraphOptions& options)
      : graph_(graph),
        options_(options),
        structure_(analyse_pose_graph(graph)),
        loss_(make_loss(options)),
        manifold_(make_manifold(graph)) {
    for (const auto& vertex : graph.vertices) poses_.push_back(vertex.world_from_vertex);
  }

  [[nodiscard]] const PoseGraphStructure& structure() const { return structure_; }
  [[nodiscard]] const std::vector<Rigid3>& poses() const { return poses_; }

  /// Takes the start that the options ask for; says which.
  PoseGraphStart choose_start() {
    if (options_.start == PoseGraphStart::given) return PoseGraphStart::given;
    std::vector<Rigid3> relaxed = relax_chordal(graph_, structure_);
    if (relaxed.empty()) return PoseGraphStart::given;
    if (graph_.planar) std::transform(relaxed.begin(), relaxed.end(), relaxed.begin(), in_plane);
    if (options_.start == PoseGraphStart::best && cost(relaxed) >= cost(poses_)) return PoseGraphStart::given;
    poses_ = std::move(relaxed);
    return PoseGraphStart::chordal;
  }

  ceres::Solver::Summary solve(ceres::IterationCallback* callback) {
    blocks_.resize(poses_.size());
    for (std::size_t i = 0; i < poses_.size(); ++i) store_pose(poses_[i], blocks_[i].data());
    ceres::Problem problem(problem_options());
    add_edges(problem);
    ceres::Solver::Summary summary;
    ceres::Solve(solver_options(callback), &problem, &summary);
    if (summary.IsSolutionUsable()) {
      for (std::size_t i = 0; i < poses_.size(); ++i) {
        if (!structure_.held[i]) poses_[i] = pose_of(blocks_[i].data());
      }
    }
    return summary;
  }

 private:
  [[nodiscard]] double cost(const std::vector<Rigid3>& poses) const {
    double sum = 0;
    for (std::size_t k = 0; k < structure_.ends.size(); ++k) {
      const auto [a, b] = structure_.ends[k];
      const auto& edge = graph_.edges[k];
      const Vector6d error = edge_error(graph_, edge, poses[a], poses[b]);
      std::array<double, 3> rho{error.dot(edge.information * error), 1.0, 0.0};
      if (edge.robust && loss_) loss_->Evaluate(rho[0], rho.data());
      sum += rho[0];
    }
    return sum;
  }

  static ceres::Problem::Options problem_options() {
    ceres::Problem::Options options;
    options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    return options;
  }

  void add_edges(ceres::Problem& problem) {
    for (std::size_t k = 0; k < structure_.ends.size(); ++k) {
      const auto [a, b] = structure_.ends[k];
      if (structure_.held[a] && structure_.held[b]) continue;
      const auto& edge = graph_.edges[k];
      problem.AddResidualBlock(new EdgeCost(graph_, edge), edge.robust ? loss_.get() : nullptr,
                               blocks_[a].data(), blocks_[b].data());
    }
    for (std::size_t i = 0; i < blocks_.size(); ++i) {
      if (!problem.HasParameterBlock(blocks_[i].data())) continue;
      problem.SetManifold(blocks_[i].data(), manifold_.get());
      if (structure_.held[i]) problem.SetParameterBlockConstant(blocks_[i].data());
    }
  }

  [[nodiscard]] ceres::Solver::Options solver_options(ceres::IterationCallback* callback) const {
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
    options.sparse_linear_algebra_library_type = ceres::EIGEN_SPARSE;  // others' bits depend on the BLAS
    options.num_threads = 1;
    options.max_num_iterations = options_.max_iterations;
    options.function_tolerance = options_.relative_tolerance;
    options.gradient_tolerance = 1e-9;  // for graphs without noise, whose cost falls to nothing
    options.parameter_tolerance = 1e-14;
    // Close to Gauss-Newton from the start: Ceres' 1e4 spends two to five times the iterations on creeping
    // along the flat directions of long chains. Should a step fail, the radius shrinks by itself.
    options.initial_trust_region_radius = 1e9;
    options.logging_type = ceres::SILENT;
    options.callbacks.push_back(callback);
    return options;
  }

  const PoseGraph& graph_;
  const PoseGraphOptions& options_;
  PoseGraphStructure structure_;
  std::unique_ptr<ceres::LossFunction> loss_;
  std::unique_ptr<ceres::Manifold> manifold_;
  std::vector<Rigid3> poses_;
  std::vector<PoseBlock> blocks_;
};

class ProgressCallback : public ceres::IterationCallback {
 public:
  explicit ProgressCallback(Progress* progress) : progress_(progress) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    if (progress_ == nullptr) return ceres::SOLVER_CONTINUE;
    progress_->update(summary.iteration);
    return progress_->stop_requested() ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
  }

 private:
  Progress* progress_;
};

void set_poses(const std::vector<Rigid3>& poses, PoseGraph& graph) {
  for (std::size_t i = 0; i < poses.size(); ++i) graph.vertices[i].world_from_vertex = poses[i];
}

}  // namespace

void PoseGraphOptions::validate() const {
  require(robust_scale > 0 && std::isfinite(robust_scale), "robust_scale is above 0");
  require(max_iterations > 0, "max_iterations is above 0");
  require(relative_tolerance > 0 && relative_tolerance < 1, "relative_tolerance is between 0 and 1");
}

PoseGraphReport optimize_pose_graph(PoseGraph& graph, const PoseGraphOptions& options, Progress* progress) {
  options.validate();
  const auto begun = std::chrono::steady_clock::now();
  PoseGraphReport report;
  report.chi2_before = chi2(graph);
  PoseGraphProblem problem(graph, options);
  report.components = problem.structure().components;
  for (std::size_t i = 0; i < graph.vertices.size(); ++i) {
    if (problem.structure().held[i]) report.held.push_back(graph.vertices[i].id);
  }
  report.started_at = problem.choose_start();
  set_poses(problem.poses(), graph);
  report.chi2_start = chi2(graph);
  ProgressCallback callback(progress);
  if (progress != nullptr) progress->start("graph", options.max_iterations, "steps");
  const ceres::Solver::Summary summary = problem.solve(&callback);
  if (progress != nullptr) progress->finish();
  set_poses(problem.poses(), graph);
  report.chi2_after = chi2(graph);
  report.iterations = std::max(0, static_cast<int>(summary.iterations.size()) - 1);  // without the start
  report.converged = summary.termination_type == ceres::CONVERGENCE;
  report.termination = summary.message;
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  return report;
}

}  // namespace cairn
