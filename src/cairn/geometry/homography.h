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

/// Computes the squared distance of (a, b) in R^4 from the pairs that H maps onto each other, to first order
/// (Sampson error; Hartley and Zisserman 2004, sec. 4.2.6). Returns infinity if H maps `a` behind the camera.
[[nodiscard]] double homography_sampson_error(const Eigen::Matrix3d& H, const Eigen::Vector2d& a,
                                              const Eigen::Vector2d& b);

/// Fits the homography with the least algebraic error to the pairs at the positions `used`, coordinates
/// normalised (DLT; Hartley and Zisserman 2004, algorithm 4.2). With `weighting` each pair counts by the
/// inverse covariance of its two equations at that homography; a few repetitions then reach the least Sampson
/// error up to terms of second order. Returns nullopt if there are fewer than four pairs or they do not
/// determine it, for example if three of four points lie on a line.
[[nodiscard]] std::optional<Eigen::Matrix3d> fit_homography(std::span<const Eigen::Vector2d> a,
                                                            std::span<const Eigen::Vector2d> b,
                                                            std::span<const std::int32_t> used,
                                                            const Eigen::Matrix3d* weighting = nullptr);

/// Computes the motions b_from_a that are possible for the homography of a plane, translations in units of
/// the plane's distance from a: with H scaled to a middle singular value of 1, H = R + t n^T has the
/// solutions (R1, t1), (R1, -t1), (R2, t2), (R2, -t2), each with its normal (Ma, Soatto, Kosecka, Sastry
/// 2004, An Invitation to 3-D Vision, sec. 5.3.3). Points in front of both cameras rule out two of them,
/// seldom three. Throws PreconditionError if an element is not finite.
[[nodiscard]] std::array<Rigid3, 4> decompose_homography(const Eigen::Matrix3d& H);

/// Estimates the homography of two views by RANSAC: samples of four, scored by homography_sampson_error with
/// the limit kInlierLimit2. `a` and `b` are (x/z, y/z) of corresponding points, by position; `sigma` is the
/// standard deviation of their coordinates. Throws PreconditionError if the spans differ in length, a
/// coordinate is not finite, or `sigma` is not above 0.
[[nodiscard]] RansacResult<Eigen::Matrix3d> find_homography(std::span<const Eigen::Vector2d> a,
                                                            std::span<const Eigen::Vector2d> b, double sigma,
                                                            const RansacOptions& options);

}  // namespace cairn
