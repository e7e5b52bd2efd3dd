// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "cairn/geometry/rigid3.h"

namespace cairn {

/// Names the model that explains the points of two views.
enum class TwoViewModel {
  essential,   ///< a scene in depth, seen by a camera that moved
  homography,  ///< a plane, seen by a camera that moved
  rotation,    ///< a camera that only rotated: its translation shows in no point
};

[[nodiscard]] std::string_view to_string(TwoViewModel model);

/// Describes which of the three models explains a set of pairs: the one with the least GRIC (Torr 1998,
/// "Geometric motion segmentation and model selection", eq. 40)
///
///     sum_i min(e_i^2 / sigma^2, 2 (4 - d)) + n d log 4 + k log(4 n)
///
/// over the n pairs that at least one model explains within its 2 (4 - d): other pairs are evidence for no
/// model, but would penalise the models of lower dimension more. e_i is the Sampson error, d the dimension of
/// what the model leaves free for a pair in R^4 (3 for an essential matrix, 2 for a homography and a
/// rotation), k the number of its parameters (5, 8, 3).
struct ModelChoice {
  TwoViewModel model = TwoViewModel::essential;
  std::size_t pairs = 0;         ///< number of pairs that at least one model explains
  std::array<double, 3> gric{};  ///< indexed by TwoViewModel; infinite for a model that was not found
};

/// Chooses the model of pairs `a` and `b`, (x/z, y/z), with standard deviation `sigma`. Either matrix may be
/// null; the rotation is fitted to the inliers of the homography. Throws PreconditionError if the spans
/// differ in length or `sigma` is not above 0.
[[nodiscard]] ModelChoice choose_model(std::span<const Eigen::Vector2d> a, std::span<const Eigen::Vector2d> b,
                                       double sigma, const Eigen::Matrix3d* essential,
                                       const Eigen::Matrix3d* homography);

/// Computes the rotation R from a to b with the least squared distances of the unit rays R a and b, over the
/// pairs at the positions `used`.
[[nodiscard]] Eigen::Quaterniond fit_rotation(std::span<const Eigen::Vector2d> a,
                                              std::span<const Eigen::Vector2d> b,
                                              std::span<const std::int32_t> used);

}  // namespace cairn
