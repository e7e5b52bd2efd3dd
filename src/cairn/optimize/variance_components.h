// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace cairn {

/// Estimates variance components (Foerstner 1979): row i of `parts` times them, plus known[i], is the
/// variance of an error whose square is squares[i], which counts as weights[i] errors. All are 0 or more, and
/// all have as many rows.
struct VarianceComponents {
  Eigen::ArrayXXd parts;
  Eigen::ArrayXd known, squares, weights;
  double cut = 1;   ///< variances at which squares are cut off (Huber 1964, proposal 2)
  double kept = 1;  ///< what a square that is cut off so is divided by: its mean if honest, in variances

  /// Makes room for `rows` errors: parts and weights of 1, the rest 0.
  VarianceComponents(Eigen::Index rows, Eigen::Index components);

  /// Returns the components after a step of the iteration that keeps them positive (Zhou, Hu, Zhou, Lange
  /// 2019, "MM algorithms for variance components models"), with variances of `least` at least, above 0. A
  /// component that no error has becomes 0.
  [[nodiscard]] Eigen::ArrayXd improved(const Eigen::ArrayXd& components, double least) const;
};

}  // namespace cairn
