// SPDX-License-Identifier: Apache-2.0
#include "cairn/geometry/robust_kernel.h"

#include <cmath>

namespace cairn {

double kernel_cost(RobustKernel kernel, double scale, double s) {
  const double c2 = scale * scale;
  switch (kernel) {
    case RobustKernel::huber:
      return s <= c2 ? s : 2 * scale * std::sqrt(s) - c2;
    case RobustKernel::cauchy:
      return c2 * std::log1p(s / c2);
    case RobustKernel::geman_mcclure:
      return c2 * s / (c2 + s);
    case RobustKernel::none:
      break;
  }
  return s;
}

double kernel_weight(RobustKernel kernel, double scale, double s) {
  const double c2 = scale * scale;
  switch (kernel) {
    case RobustKernel::huber:
      return s <= c2 ? 1.0 : scale / std::sqrt(s);
    case RobustKernel::cauchy:
      return c2 / (c2 + s);
    case RobustKernel::geman_mcclure:
      return c2 * c2 / ((c2 + s) * (c2 + s));
    case RobustKernel::none:
      break;
  }
  return 1.0;
}

}  // namespace cairn
