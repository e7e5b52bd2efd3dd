// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cairn/core/executor.h"
#include "cairn/features/sift_scale_space.h"

namespace cairn {

/// Sets which extrema become keypoints.
struct SiftExtremaOptions {
  /// Smallest |D| at an extremum, as a share of the range of grey values and times the number of layers,
  /// because D falls with their distance (Lowe 2004, section 4): 0.02 / 3 of 255 are 1.7 grey levels. That is
  /// low, for dim images: the weakest are left out anyway if there are more than wanted.
  double contrast = 0.02;
  /// Largest ratio of the principal curvatures of D; above, the point lies on an edge, along which its
  /// position is not defined (section 4.1).
  double edge_ratio = 10;
};

/// Describes an extremum of the differences of Gaussians D.
struct ScalePoint {
  int octave = 0;
  float x = 0, y = 0;  ///< pixels of the octave
  float level = 0;     ///< may lie between levels; its smoothing is ScaleSpace::sigma(level)
  float response = 0;  ///< |D| at the extremum, grey levels
};

/// Finds the extrema of D over position and scale, refined to a fraction of a pixel and of a level by a
/// parabola (Brown and Lowe 2002; Lowe 2004, sections 3.1 to 4.1), strongest first.
[[nodiscard]] std::vector<ScalePoint> find_sift_extrema(const ScaleSpace& space,
                                                        const SiftExtremaOptions& options,
                                                        const Executor& executor);

}  // namespace cairn
