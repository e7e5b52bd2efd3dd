// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

namespace cairn {

/// Coefficients in the model's order, 0 where unused.
using Distortion = std::array<double, 5>;
/// Derivatives of a distorted point by the coefficients.
using DistortionJacobian = Eigen::Matrix<double, 2, 5>;

// One namespace per lens model, all with the same functions, over points (x/z, y/z) of the image plane at
// distance 1. Each model is used within its field: from the centre to where the image would fold back. There
// `distort` and `undistort` undo each other; outside both give nothing.

/// Brown-Conrady k1 k2 p1 p2 k3: OpenCV's documentation of calib3d, "Detailed description".
namespace radtan {
/// Ends where the radial distortion folds back; tangential terms left out: they are small.
[[nodiscard]] bool is_in_field(const Distortion& k, const Eigen::Vector2d& p);
[[nodiscard]] Eigen::Vector2d distort(const Distortion& k, const Eigen::Vector2d& p);
[[nodiscard]] Eigen::Matrix2d distort_by_point(const Distortion& k, const Eigen::Vector2d& p);
[[nodiscard]] DistortionJacobian distort_by_coefficients(const Eigen::Vector2d& p);
/// Nothing for a point that no point of the field is distorted to.
[[nodiscard]] std::optional<Eigen::Vector2d> undistort(const Distortion& k, const Eigen::Vector2d& distorted);
}  // namespace radtan

/// Kannala and Brandt 2006, eq. 6 with the odd powers up to 9, k1..k4 (OpenCV's fisheye).
namespace kb4 {
/// Ends where the distortion folds back, and at 89 degrees: beyond there is no finite (x/z, y/z).
[[nodiscard]] bool is_in_field(const Distortion& k, const Eigen::Vector2d& p);
[[nodiscard]] Eigen::Vector2d distort(const Distortion& k, const Eigen::Vector2d& p);
[[nodiscard]] Eigen::Matrix2d distort_by_point(const Distortion& k, const Eigen::Vector2d& p);
[[nodiscard]] DistortionJacobian distort_by_coefficients(const Eigen::Vector2d& p);
/// Nothing for a point that no point of the field is distorted to.
[[nodiscard]] std::optional<Eigen::Vector2d> undistort(const Distortion& k, const Eigen::Vector2d& distorted);
}  // namespace kb4

}  // namespace cairn
