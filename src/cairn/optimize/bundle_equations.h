// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "cairn/core/executor.h"
#include "cairn/optimize/block_cholesky.h"
#include "cairn/optimize/bundle_field.h"
#include "cairn/optimize/bundle_structure.h"

namespace cairn {

/// Describes camera_from_world with the rotation as a matrix, which is faster to apply to many points.
struct MatrixPose {
  Eigen::Matrix3d rotation;
  Eigen::Vector3d translation;

  [[nodiscard]] Eigen::Vector3d operator*(const Eigen::Vector3d& point) const {
    return rotation * point + translation;
  }
};

[[nodiscard]] inline MatrixPose to_matrix_pose(const Rigid3& pose) {
  return {pose.matrix3(), pose.translation};
}
[[nodiscard]] std::vector<MatrixPose> to_matrix_poses(const std::vector<Rigid3>& poses);

/// Holds the estimates of cameras and points, and the cost rho(squared_error) of each term.
struct BundleState {
  std::vector<Rigid3> camera_from_world;
  std::vector<MatrixPose> matrix_poses;           ///< camera_from_world as matrices
  std::vector<Eigen::Vector3d> points;            ///< in the structure's order
  DisparityField field = DisparityField::Zero();  ///< stays zero unless it is estimated
  std::vector<double> term_costs;
  double cost = 0;  ///< half the sum of term_costs, and the cost of the field's prior

  /// Takes the start of the problem; all costs are 0.
  BundleState(const BundleProblem& problem, const BundleStructure& structure);
  /// Sets the pose of a camera in both forms.
  void set_camera(std::size_t camera, const Rigid3& pose);
  /// Sets `cost` to half the sum of term_costs.
  void sum_costs();
};

/// Holds and solves the normal equations of a bundle. With U the cameras' part, V the points' (3x3 blocks on
/// its diagonal) and Z between the two, J^T W J = (U Z; Z^T V), all damped by Marquardt's lambda times their
/// diagonal. With V = L L^T (Cholesky), Y = Z L^-T and h = L^-1 g_points,
///
///     (U - Y Y^T) step_cameras = -g_cameras + Y h,    step_points = -L^-T (h + Y^T step_cameras).
///
/// A camera moved by (w, v) moves a point p in it by -[p]x w + v, so one link's blocks of U and Z follow from
/// the gradient g and the Hessian H of its cost by p: with B = (-[p]x, I), U = B^T H B and Z = B^T H R.
///
/// With a FieldBorder, the field of the disparities is one more unknown, and all steps are with it.
class BundleEquations {
 public:
  /// Refers to its arguments, which must outlive it. Without a border no field is estimated.
  BundleEquations(const Rig& rig, const BundleStructure& structure, const BundleOptions& options,
                  const Executor& executor, FieldBorder* border = nullptr);

  /// Builds the equations at the state. Drops the terms behind their camera and those of undetermined points.
  void build(const BundleState& state, double lambda);
  /// Solves for the step of the cameras and the field. Returns false if their equations have no solution.
  [[nodiscard]] bool solve();
  /// Computes the state after the step and its costs. A point that its step would move behind a camera is not
  /// moved. A dropped term, and one that is behind its camera nevertheless, keeps its cost.
  void move(const BundleState& from, BundleState& to) const;
  /// Computes the costs at the state; a term behind its camera keeps its cost.
  void evaluate_costs(BundleState& state) const;
  /// Returns the number of disparities that are not dropped.
  [[nodiscard]] std::size_t count_disparities() const;

  /// Returns the equations of the cameras alone, U - Y Y^T, as last built.
  [[nodiscard]] const BlockMatrix& reduced_matrix() const { return reduced_; }
  /// Adds what a point, in the structure's order, adds to the gradient of the cameras' equations, six for
  /// each free camera, and of the border's; nothing for a point that was dropped. Needs a border.
  void add_gradient(std::size_t point, Eigen::Ref<Eigen::VectorXd> cameras, Eigen::Vector3d& field) const;

 private:
  /// Holds a term of a free camera: p, and gradient and Hessian of its cost by p.
  struct Link {
    Eigen::Vector3d point_in_camera = Eigen::Vector3d::Zero();
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
    Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
  };
  using LinkBlock = Eigen::Matrix<double, 6, 3>;
  /// Holds L below the diagonal, its inverse diagonal, and h; all zero for a point that is not moved.
  struct PointFactor {
    double l10 = 0, l20 = 0, l21 = 0;
    Eigen::Vector3d inverse_diagonal = Eigen::Vector3d::Zero();
    Eigen::Vector3d h = Eigen::Vector3d::Zero();
  };

  void find_pattern();
  void build_point(std::size_t point, const BundleState& state, double lambda);
  [[nodiscard]] PointSums expand_terms(std::size_t point, const BundleState& state);
  void clear_link(std::size_t link);
  void drop_terms(std::size_t point);
  [[nodiscard]] static PointFactor factorise(const PointSums& sums, double lambda);
  template <int kRows>
  static void whiten(const PointFactor& factor, Eigen::Matrix<double, kRows, 3>& block);
  static void add_link(const Link& link, Matrix6d& hessian, Vector6d& gradient);
  void build_column(std::size_t free, double lambda);
  void build_border_point(std::size_t point);
  void build_border_column(std::size_t free);
  [[nodiscard]] bool solve_bordered();
  [[nodiscard]] const BundleTerm& term_at(std::size_t t, const BundleState& state,
                                          BundleTerm& corrected) const;
  void sum_costs(BundleState& state) const;
  [[nodiscard]] Vector6d prior_error(std::size_t free, const BundleState& state) const;
  [[nodiscard]] Eigen::Vector3d point_step(std::size_t point) const;
  void move_cameras(const BundleState& from, BundleState& to) const;
  void move_point(std::size_t point, const BundleState& from, BundleState& to) const;
  bool price_point(std::size_t point, const std::vector<double>& costs_before, BundleState& state) const;

  const Rig& rig_;
  const BundleStructure& structure_;
  const BundleOptions& options_;
  const Executor& executor_;
  FieldBorder* border_;                 // nullptr if no field is estimated
  std::vector<char> active_;            // by term
  std::vector<Link> links_;             // by link
  std::vector<LinkBlock> link_blocks_;  // Z, then Y
  std::vector<PointFactor> factors_;    // by point
  std::vector<Vector6d> prior_errors_;  // by free camera
  BlockMatrix reduced_;                 // U - Y Y^T
  std::vector<std::int32_t> block_of_;  // its block at (row, column) for each row of each column
  std::unique_ptr<BlockCholesky> solver_;
  Eigen::VectorXd right_, camera_step_;
};

}  // namespace cairn
