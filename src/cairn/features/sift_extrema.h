// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cairn/core/executor.h"
#include "cairn/features/sift_scale_space.h"

namespace cairn {

struct SiftExtremaOptions {
  /// Smallest |D| at an extremum, as a share of the range of grey values and times the number of layers,
  /// because D falls with their distance (Lowe 2004, section 4): 0.02 / 3 of 255 are 1.7 grey levels. That is
  /// low, for dim images: where there is more than wanted, the weakest are left out anyway.
  double contrast = 0.02;
  /// Largest ratio of the principal curvatures of D: above, it is an edge, along which the place is not
  /// defined (section 4.1).
  double edge_ratio = 10;
};

/// An extremum of the differences of Gaussians D.
struct ScalePoint {
  int octave = 0;
  float x = 0, y = 0;  ///< pixels of the octave
  float level = 0;     ///< between levels; its smoothing is ScaleSpace::sigma(level)
  float response = 0;  ///< |D| there, grey levels
};

/// Extrema of D over place and scale, refined to a fraction of a pixel and of a level by a parabola
/// (Brown and Lowe 2002; Lowe 2004, sections 3.1 to 4.1), strongest first.
[[nodiscard]] std::vector<ScalePoint> find_sift_extrema(const ScaleSpace& space,
                                                        const SiftExtremaOptions& options,
                                                        const Executor& executor);

}  // namespace cairn
