// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cairn/features/sift_extrema.h"

namespace cairn {

constexpr int kPatchSlack = 16;  ///< floats readable after a patch, for kernels

/// Describes a square patch around a scale point.
struct Patch {
  double angle_deg = 0;  ///< direction of its columns, clockwise from the x axis
  double step = 1;       ///< between samples, in sigmas of the point
  /// Gradients on a side; those between the first gradients + 1 samples lie around the point.
  int gradients = 0;
  int side = 0;  ///< samples on a side, a multiple of 16
};

/// Samples a patch on the level of the point's octave whose smoothing is nearest to the point's.
void sample_patch(const ScaleSpace& space, const ScalePoint& point, const Patch& patch, float* samples);

/// Prefetches the pixels of patches that reach `reach` sigmas around the point.
void prefetch_patch(const ScaleSpace& space, const ScalePoint& point, double reach);

}  // namespace cairn
