// SPDX-License-Identifier: Apache-2.0
#include "cairn/geometry/kernel_moments.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cairn/core/error.h"

namespace cairn {
namespace {

/// Density of the length t of a standard normal vector with two or three elements, t^2 = s.
double length_density(double t, int dimension) {
  const double gauss = std::exp(-0.5 * t * t);
  return dimension == 2 ? t * gauss : std::sqrt(2 / std::numbers::pi) * t * t * gauss;
}

/// Sums over errors of the given variance and of lengths from `begin` to `end`, by Simpson's rule.
void add_moments(RobustKernel kernel, double scale, int dimension, double variance, double begin, double end,
                 KernelMoments& sums) {
  constexpr int kPanels = 96;  // an even number
  for (int i = 0; i <= kPanels; ++i) {
    const double t = begin + (end - begin) * i / kPanels, s = variance * t * t;
    const double simpson = (i == 0 || i == kPanels ? 1 : i % 2 == 1 ? 4 : 2) * (end - begin) / (3 * kPanels);
    const double density = simpson * length_density(t, dimension);
    const double weight = kernel_weight(kernel, scale, s);
    sums.share += density;
    sums.weight += density * weight;
    sums.squares += density * weight * s;
    sums.force += density * weight * weight * s;
  }
}

/// Means over errors of the given variance whose squared length is below the limit. In pieces: up to the
/// scale of the kernel, from where it bends, then up to ten times as far each, so that narrow kernels are
/// resolved, too.
KernelMoments moments_at(RobustKernel kernel, double scale, int dimension, double limit, double variance) {
  constexpr double kLongest = 8;  // standard deviations: longer errors are rarer than 1e-13
  const double end = std::min(kLongest, std::sqrt(limit / variance));
  KernelMoments sums{0, 0, 0, 0, 0, 0};
  double begin = 0;
  if (kernel != RobustKernel::none) {
    for (double next = scale / std::sqrt(variance); next < end; next *= 10) {
      add_moments(kernel, scale, dimension, variance, begin, next, sums);
      begin = next;
    }
  }
  add_moments(kernel, scale, dimension, variance, begin, end, sums);
  sums.weight /= sums.share;
  sums.squares /= sums.share;
  sums.force /= sums.share * dimension;
  sums.sensitivity = sums.squares / dimension;
  return sums;
}

}  // namespace

KernelMoments kernel_moments(RobustKernel kernel, double scale, int degrees_of_freedom, double limit) {
  require(degrees_of_freedom == 2 || degrees_of_freedom == 3, "an observation has two or three coordinates");
  require(limit > 0, "the limit is above 0");
  constexpr double kStep = 0.1;
  KernelMoments moments = moments_at(kernel, scale, degrees_of_freedom, limit, 1);
  const KernelMoments smaller = moments_at(kernel, scale, degrees_of_freedom, limit, 1 - kStep);
  moments.slope = (moments.squares - smaller.squares) / kStep;
  return moments;
}

}  // namespace cairn
