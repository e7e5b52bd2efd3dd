// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "cairn/core/executor.h"
#include "cairn/image/image.h"

namespace cairn {

/// Describes a pixel that differs from the circle around it.
struct Corner {
  std::int32_t u = 0, v = 0;
  std::int32_t score = 0;  ///< highest threshold at which it is still found, grey levels
};

/// Sets thresholds and cells of detect_fast.
struct FastOptions {
  int threshold = 20;  ///< grey levels by which 9 of the 16 pixels around differ; [1, 254]
  /// Threshold for cells without a corner, [1, threshold]; equal to threshold: no retry.
  int retry_threshold = 7;
  int cell = 64;   ///< side of the cells, pixels
  int border = 4;  ///< width of the border without corners, pixels, at least 4
};

/// Detects FAST-9 corners (Rosten and Drummond 2006) with the best score among their 8 neighbours, row by
/// row. Searches cells without any corner again with the lower threshold. Throws PreconditionError if an
/// option is out of range.
[[nodiscard]] std::vector<Corner> detect_fast(const GrayImage& image, const FastOptions& options = {},
                                              const Executor& executor = Executor());

/// Computes Harris' measure (Harris and Stephens 1988) in a window of 7x7: determinant - 0.04 trace^2 of the
/// structure tensor of gradients in [-1, 1]. The larger, the better the pixel can be located. The pixel must
/// lie at least 5 pixels inside the image.
[[nodiscard]] float harris_measure(const GrayImage& image, int u, int v);

}  // namespace cairn
