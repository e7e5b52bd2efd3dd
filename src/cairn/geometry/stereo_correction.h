// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "cairn/geometry/rig.h"

namespace cairn {

/// Holds c0, c1, c2, pixels: a stereo pair measures the disparity of a point too large by c0 + c1 x + c2 x^2,
/// with x = (u - cx) / fx of the left pixel. A turned right camera, a wrong principal point and distortion
/// that was not taken away look like that.
using DisparityField = Eigen::Vector3d;

/// Computes (1, x, x^2) at the left column `u`: the field's error there is the product with its coefficients.
[[nodiscard]] inline Eigen::Vector3d disparity_field_basis(const Rig& rig, double u) {
  const double x = (u - rig.cx) / rig.fx;
  return {1.0, x, x * x};
}

/// Holds the factors of 1, x, y, x y, x^2, y^2, pixels: a point on row v of the left image lies on row
/// v - field of the right one, with x and y the ray through the right column and the left row.
using RowField = Eigen::Matrix<double, 6, 1>;

/// Computes (1, x, y, x y, x^2, y^2) at the right column `u_right` and the left row `v_left`.
[[nodiscard]] inline RowField row_field_basis(const Rig& rig, double u_right, double v_left) {
  const double x = (u_right - rig.cx) / rig.fx, y = (v_left - rig.cy) / rig.fy;
  return (RowField() << 1.0, x, y, x * y, x * x, y * y).finished();
}

/// Describes how the images of a stereo pair differ from what its calibration says of them.
struct StereoCorrection {
  RowField rows = RowField::Zero();
  DisparityField disparity = DisparityField::Zero();

  /// Computes the right row on which a point of the left row `v_left` lies at the right column `u_right`.
  [[nodiscard]] double right_row(const Rig& rig, double u_right, double v_left) const {
    return v_left - rows.dot(row_field_basis(rig, u_right, v_left));
  }
  /// Computes the pixel of the recorded right image that shows what the left one shows at (u, v), with the
  /// corrected disparity `d`.
  [[nodiscard]] Eigen::Vector2d right_pixel(const Rig& rig, double u, double v, double d) const {
    const double u_right = u - d - disparity.dot(disparity_field_basis(rig, u));
    return {u_right, right_row(rig, u_right, v)};
  }
  /// Computes the disparity of a point that was measured with `disparity_px` at the left column `u`.
  [[nodiscard]] double corrected(const Rig& rig, double u, double disparity_px) const {
    return disparity_px - disparity.dot(disparity_field_basis(rig, u));
  }
};

}  // namespace cairn
