// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "cairn/geometry/rigid3.h"

namespace cairn {

/// What explains the points of two views.
enum class TwoViewModel {
  essential,   ///< a scene in depth, seen by a camera that moved
  homography,  ///< a plane, seen by a camera that moved
  rotation,    ///< a camera that only turned: its translation shows in no point
};

[[nodiscard]] std::string_view to_string(TwoViewModel model);

/// Which of the three models a set of pairs is to be explained with: the one with the least GRIC (Torr 1998,
/// "Geometric motion segmentation and model selection", eq. 40)
///
///     sum_i min(e_i^2 / sigma^2, 2 (4 - d)) + n d log 4 + k log(4 n)
///
/// over the n pairs that one of them explains within its 2 (4 - d): other pairs are no evidence for any, but
/// would cost the models of lower dimension more. e_i is the Sampson error, d the dimension of what the model
/// leaves free for a pair in R^4 (3 for an essential matrix, 2 for a homography and a rotation), k its
/// parameters (5, 8, 3).
struct ModelChoice {
  TwoViewModel model = TwoViewModel::essential;
  std::size_t pairs = 0;         ///< that one of the models explains
  std::array<double, 3> gric{};  ///< by TwoViewModel; infinite for a model that was not found
};

[[nodiscard]] ModelChoice choose_model(std::span<const Eigen::Vector2d> a, std::span<const Eigen::Vector2d> b,
                                       double sigma, const Eigen::Matrix3d* essential,
                                       const Eigen::Matrix3d* homography);

/// The rotation with the least squared distances of rays R a and b, the pairs at the positions `used`.
[[nodiscard]] Eigen::Quaterniond fit_rotation(std::span<const Eigen::Vector2d> a,
                                              std::span<const Eigen::Vector2d> b,
                                              std::span<const std::int32_t> used);

}  // namespace cairn
