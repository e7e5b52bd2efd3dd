// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

namespace cairn {

/// Coefficients of a distortion in the model's order, 0 if unused.
using Distortion = std::array<double, 5>;
/// Derivative of a distorted point by the coefficients, one column each.
using DistortionJacobian = Eigen::Matrix<double, 2, 5>;

// One namespace per lens model, all with the same functions, over points (x/z, y/z) of the image plane at
// distance 1. Each model is used within its field: from the centre to where the image would fold back. There
// `distort` and `undistort` undo each other; outside, `undistort` returns nullopt and `distort` means
// nothing.

/// Brown-Conrady k1 k2 p1 p2 k3: OpenCV's documentation of calib3d, "Detailed description".
namespace radtan {
/// Tells whether a point lies in the field, which ends at the radius where the radial distortion folds back.
/// The tangential terms are neglected: they are small.
[[nodiscard]] bool is_in_field(const Distortion& k, const Eigen::Vector2d& p);
/// Distorts a point; not checked against the field.
[[nodiscard]] Eigen::Vector2d distort(const Distortion& k, const Eigen::Vector2d& p);
/// Computes the derivative of `distort` by the point.
[[nodiscard]] Eigen::Matrix2d distort_by_point(const Distortion& k, const Eigen::Vector2d& p);
/// Computes the derivative of `distort` by the coefficients.
[[nodiscard]] DistortionJacobian distort_by_coefficients(const Eigen::Vector2d& p);
/// Inverts `distort`. Returns nullopt if no point of the field is distorted to `distorted`.
[[nodiscard]] std::optional<Eigen::Vector2d> undistort(const Distortion& k, const Eigen::Vector2d& distorted);
}  // namespace radtan

/// Kannala and Brandt 2006, eq. 6 with the odd powers up to 9, k1..k4 (OpenCV's fisheye).
namespace kb4 {
/// Tells whether a point lies in the field, which ends where the distortion folds back, at most at 89
/// degrees: beyond there is no finite (x/z, y/z).
[[nodiscard]] bool is_in_field(const Distortion& k, const Eigen::Vector2d& p);
/// Distorts a point; not checked against the field.
[[nodiscard]] Eigen::Vector2d distort(const Distortion& k, const Eigen::Vector2d& p);
/// Computes the derivative of `distort` by the point.
[[nodiscard]] Eigen::Matrix2d distort_by_point(const Distortion& k, const Eigen::Vector2d& p);
/// Computes the derivative of `distort` by the coefficients.
[[nodiscard]] DistortionJacobian distort_by_coefficients(const Eigen::Vector2d& p);
/// Inverts `distort`. Returns nullopt if no point of the field is distorted to `distorted`.
[[nodiscard]] std::optional<Eigen::Vector2d> undistort(const Distortion& k, const Eigen::Vector2d& distorted);
}  // namespace kb4

}  // namespace cairn
