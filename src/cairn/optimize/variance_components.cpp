// SPDX-License-Identifier: Apache-2.0
#include "cairn/optimize/variance_components.h"

#include <algorithm>
#include <cmath>

namespace cairn {

VarianceComponents::VarianceComponents(Eigen::Index rows, Eigen::Index components)
    : parts(Eigen::ArrayXXd::Ones(rows, components)),
      known(Eigen::ArrayXd::Zero(rows)),
      squares(Eigen::ArrayXd::Zero(rows)),
      weights(Eigen::ArrayXd::Ones(rows)) {}

Eigen::ArrayXd VarianceComponents::improved(const Eigen::ArrayXd& components, double least) const {
  Eigen::ArrayXd found = Eigen::ArrayXd::Zero(components.size()), expected = found;
  for (Eigen::Index row = 0; row < squares.size(); ++row) {
    double variance = known[row];
    for (Eigen::Index k = 0; k < components.size(); ++k) variance += components[k] * parts(row, k);
    variance = std::max(variance, least);
    const double square = std::min(squares[row], cut * variance) / kept;
    const double by_found = weights[row] * (square / (variance * variance));
    for (Eigen::Index k = 0; k < components.size(); ++k) {
      found[k] += by_found * parts(row, k);
      expected[k] += weights[row] * parts(row, k) / variance;
    }
  }
  Eigen::ArrayXd next = Eigen::ArrayXd::Zero(components.size());
  for (Eigen::Index k = 0; k < components.size(); ++k)
    if (expected[k] > 0) next[k] = components[k] * std::sqrt(found[k] / expected[k]);
  return next;
}

}  // namespace cairn
