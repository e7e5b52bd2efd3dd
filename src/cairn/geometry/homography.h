// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "cairn/geometry/ransac.h"
#include "cairn/geometry/rigid3.h"

namespace cairn {

// Two views a and b of a plane, or of anything by a camera that only turned: (b, 1) ~ H (a, 1). The sign of
// H is such that the third coordinate of H (a, 1) is positive, its Frobenius norm is 1.

/// Squared distance of (a, b) in R^4 from the pairs that H maps onto each other, to first order (Sampson
/// error; Hartley and Zisserman 2004, sec. 4.2.6). Infinite for a point that H sends behind the camera.
[[nodiscard]] double homography_sampson_error(const Eigen::Matrix3d& H, const Eigen::Vector2d& a,
                                              const Eigen::Vector2d& b);

/// The homography with the least algebraic error over the pairs at the positions `used`, coordinates
/// normalised (DLT; Hartley and Zisserman 2004, algorithm 4.2). With `weighting` each pair counts by the
/// inverse covariance of its two equations at that homography, which makes a few repetitions end at the least
/// Sampson error but for terms of second order. Nothing for fewer than four pairs, or where they do not
/// determine it: three of four points on a line.
[[nodiscard]] std::optional<Eigen::Matrix3d> fit_homography(std::span<const Eigen::Vector2d> a,
                                                            std::span<const Eigen::Vector2d> b,
                                                            std::span<const std::int32_t> used,
                                                            const Eigen::Matrix3d* weighting = nullptr);

/// The motions b_from_a that a plane's homography allows for, translations in units of the plane's distance
/// from a: with H scaled to a middle singular value of 1, H = R + t n^T has the solutions (R1, t1), (R1,
/// -t1), (R2, t2), (R2, -t2), normals to match (Ma, Soatto, Kosecka, Sastry 2004, An Invitation to 3-D
/// Vision, sec. 5.3.3). Points in front of both cameras rule out two of them, seldom three.
[[nodiscard]] std::array<Rigid3, 4> decompose_homography(const Eigen::Matrix3d& H);

/// The homography of two views in RANSAC: samples of four, scored by homography_sampson_error with
/// kInlierLimit2 as limit. Arguments as those of find_essential.
[[nodiscard]] RansacResult<Eigen::Matrix3d> find_homography(std::span<const Eigen::Vector2d> a,
                                                            std::span<const Eigen::Vector2d> b, double sigma,
                                                            const RansacOptions& options);

}  // namespace cairn
