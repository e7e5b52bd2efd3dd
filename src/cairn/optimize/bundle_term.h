// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/LU>
#include <cstdint>

#include "cairn/optimize/bundle_adjustment.h"

namespace cairn {

/// Holds one observation as the equations need it.
struct BundleTerm {
  Eigen::Vector3d seen;               ///< u, v, d; 0 for a disparity that was not measured
  Eigen::Vector3d inverse_variances;  ///< 0 for a disparity that was not measured
  std::int32_t camera;                ///< position in the problem

  [[nodiscard]] double squared_error(const Eigen::Vector3d& error) const {
    return error.dot(inverse_variances.cwiseProduct(error));
  }
};

/// Converts an observation to a term.
[[nodiscard]] inline BundleTerm make_term(const BundleObservation& observation) {
  const Observation& seen = observation.seen;
  return {{seen.u, seen.v, seen.has_disparity() ? seen.d : 0.0}, inverse_variances(seen), observation.camera};
}

/// Expands half the cost of one observation to second order in the point p in the camera, as iteratively
/// reweighted Gauss-Newton takes it: gradient P^T W e and Hessian P^T W P, with e the residual, W the inverse
/// variances times the kernel's weight, and P = Rig::projection_jacobian. Only five entries of P are not
/// zero, and products with it are a large part of the cost of a bundle's equations, so they are written out
/// here.
class TermExpansion {
 public:
  /// Expands at a point that must be in front of the camera.
  TermExpansion(const Rig& rig, const Eigen::Vector3d& point_in_camera, const BundleTerm& term,
                RobustKernel kernel, double kernel_scale) {
    const double inverse_depth = 1.0 / point_in_camera.z();
    x_ = point_in_camera.x() * inverse_depth;
    y_ = point_in_camera.y() * inverse_depth;
    u_by_x_ = rig.fx * inverse_depth;
    v_by_y_ = rig.fy * inverse_depth;
    const double disparity = u_by_x_ * rig.baseline;
    d_by_z_ = -disparity * inverse_depth;
    error_ = Eigen::Vector3d(rig.fx * x_ + rig.cx, rig.fy * y_ + rig.cy, disparity) - term.seen;
    weights_ = kernel_weight(kernel, kernel_scale, term.squared_error(error_)) * term.inverse_variances;
  }

  [[nodiscard]] Eigen::Vector3d weighted_error() const { return weights_.cwiseProduct(error_); }
  [[nodiscard]] Eigen::Vector3d gradient() const { return transposed_times(weighted_error()); }
  /// Returns the weight of the disparity in W.
  [[nodiscard]] double disparity_weight() const { return weights_[2]; }
  /// Returns the derivative of the disparity by the depth, the only one that is not zero.
  [[nodiscard]] double disparity_by_depth() const { return d_by_z_; }

  [[nodiscard]] Eigen::Matrix3d hessian() const {
    const double xx = u_by_x_ * u_by_x_ * weights_[0], yy = v_by_y_ * v_by_y_ * weights_[1];
    const double xz = -x_ * xx, yz = -y_ * yy;
    Eigen::Matrix3d hessian;
    hessian << xx, 0, xz, 0, yy, yz, xz, yz, d_by_z_ * d_by_z_ * weights_[2] - x_ * xz - y_ * yz;
    return hessian;
  }

  /// Computes P M: for M = R the derivative by the point in the world.
  [[nodiscard]] Eigen::Matrix3d jacobian_times(const Eigen::Matrix3d& m) const {
    Eigen::Matrix3d product;
    product.row(0) = u_by_x_ * (m.row(0) - x_ * m.row(2));
    product.row(1) = v_by_y_ * (m.row(1) - y_ * m.row(2));
    product.row(2) = d_by_z_ * m.row(2);
    return product;
  }
  /// Computes W M.
  [[nodiscard]] Eigen::Matrix3d weights_times(const Eigen::Matrix3d& m) const {
    return weights_.asDiagonal() * m;
  }
  /// Computes P^T M.
  template <int kColumns>
  [[nodiscard]] Eigen::Matrix<double, 3, kColumns> transposed_times(
      const Eigen::Matrix<double, 3, kColumns>& m) const {
    Eigen::Matrix<double, 3, kColumns> product;
    product.row(0) = u_by_x_ * m.row(0);
    product.row(1) = v_by_y_ * m.row(1);
    product.row(2) = d_by_z_ * m.row(2) - x_ * product.row(0) - y_ * product.row(1);
    return product;
  }

 private:
  double x_, y_;                     // p.x / p.z, p.y / p.z
  double u_by_x_, v_by_y_, d_by_z_;  // of P
  Eigen::Vector3d error_, weights_;  // e and the diagonal of W
};

/// Tells whether an information matrix of a point, given by its trace and determinant, determines the point:
/// false if its smallest eigenvalue is about a billionth of its largest, which is a parallax of 3e-5 radians.
[[nodiscard]] inline bool determines_point(double trace, double determinant) {
  constexpr double kSmallestShare = 1e-9;
  const double mean = trace / 3.0;
  return determinant > kSmallestShare * mean * mean * mean;
}

/// Sums the information V and the gradient g of a point in the world.
struct PointSums {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();

  /// Adds one term whose camera has this rotation; returns P^T W P R.
  Eigen::Matrix3d add(const TermExpansion& expansion, const Eigen::Matrix3d& rotation) {
    const Eigen::Matrix3d jacobian = expansion.jacobian_times(rotation);
    const Eigen::Matrix3d weighted = expansion.weights_times(jacobian);
    information.noalias() += weighted.transpose() * jacobian;
    gradient.noalias() += jacobian.transpose() * expansion.weighted_error();
    return expansion.transposed_times(weighted);
  }

  [[nodiscard]] bool determine_point() const {
    return determines_point(information.trace(), information.determinant());
  }
};

}  // namespace cairn
