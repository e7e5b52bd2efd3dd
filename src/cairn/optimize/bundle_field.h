// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "cairn/geometry/rigid3.h"
#include "cairn/geometry/stereo_correction.h"
#include "cairn/optimize/bundle_structure.h"

namespace cairn {

/// Borders the reduced equations S of a bundle's cameras with the field c of its disparities:
///
///     (S B; B^T C) (step_cameras; step) = (r; right).
///
/// A measured disparity is modelled as d + a c, a the basis of its field, so that each is one more equation
/// between a point, a camera and the field. The field is treated as a camera of three columns that sees all
/// points: its coupling K with a point (3x3, as Z of a camera) is whitened to Y = K L^-T, and takes Y Y^T
/// from C, Y h from the gradient and (Y of the camera) Y^T from B. C has the Gaussian prior about c = 0.
class FieldBorder {
 public:
  /// Holds what a point adds to C, the gradient, and the whitened Y; all zero for a point that is not moved.
  struct Point {
    Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
    Eigen::Matrix3d coupling = Eigen::Matrix3d::Zero();
  };
  using CameraBlock = Eigen::Matrix<double, 6, 3>;

  /// Refers to its arguments, which must outlive it. `prior_sigma_px` is the prior's standard deviation of
  /// each coefficient.
  FieldBorder(const Rig& rig, const BundleStructure& structure, double prior_sigma_px);

  /// Takes the field off the disparity of a term.
  [[nodiscard]] BundleTerm correct(const BundleTerm& term, const DisparityField& field) const;
  /// Computes half the squared field in variances of the prior.
  [[nodiscard]] double prior_cost(const DisparityField& field) const;

  /// Clears a point and its links, before its terms are added or if it is not moved.
  void clear_point(std::size_t point);
  /// Adds a term of a point, its camera's rotation given, before the point is whitened.
  void add_term(std::size_t point, const BundleTerm& term, const TermExpansion& expansion,
                const Eigen::Matrix3d& rotation);
  /// Sets the part of a link in B.
  void set_link(std::size_t link, const BundleTerm& term, const TermExpansion& expansion);
  [[nodiscard]] Point& point(std::size_t point) { return points_[point]; }
  [[nodiscard]] const Point& point(std::size_t point) const { return points_[point]; }
  /// Adds the part of a link in B, its point in the camera given, to the block of its camera.
  void add_link(std::size_t link, const Eigen::Vector3d& point_in_camera, CameraBlock& block) const;
  /// Sets the block of a free camera in B.
  void set_camera(std::size_t free, const CameraBlock& block);
  /// Sums the points, whitened, to C and `right`, and damps C by Marquardt's lambda times its diagonal.
  void sum_points(const DisparityField& field, double lambda);

  /// Returns B.
  [[nodiscard]] const Eigen::MatrixX3d& cameras() const { return cameras_; }
  /// Solves for the step of the field, given S^-1 r and S^-1 B. Returns false if there is no solution.
  [[nodiscard]] bool solve(const Eigen::VectorXd& solved_right, const Eigen::MatrixX3d& solved_cameras);
  [[nodiscard]] const Eigen::Vector3d& step() const { return step_; }
  /// Returns (C - B^T S^-1 B)^-1 of the last solution: the covariance of the field, square pixels, if the
  /// equations were not damped.
  [[nodiscard]] Eigen::Matrix3d covariance() const;

 private:
  const Rig& rig_;
  const BundleStructure& structure_;
  double prior_information_;                 // of each coefficient
  std::vector<Point> points_;                // in the structure's order
  std::vector<Eigen::Vector3d> link_rows_;   // a times weight and slope by depth
  Eigen::MatrixX3d cameras_;                 // B
  Eigen::Matrix3d information_, remainder_;  // C, and C - B^T S^-1 B
  Eigen::Vector3d right_, step_;
};

}  // namespace cairn
