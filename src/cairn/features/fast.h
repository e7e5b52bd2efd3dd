// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "cairn/core/executor.h"
#include "cairn/image/image.h"

namespace cairn {

/// A pixel that stands out from the circle around it.
struct Corner {
  std::int32_t u = 0, v = 0;
  std::int32_t score = 0;  ///< highest threshold with which it is still found, grey levels
};

struct FastOptions {
  int threshold = 20;       ///< grey levels by which 9 of the 16 pixels around differ; [1, 254]
  int retry_threshold = 7;  ///< where a cell has no corner; the same as threshold: no retry
  int cell = 64;            ///< side of the cells, pixels
  int border = 4;           ///< pixels along each side where no corner is looked for, at least 4
};

/// FAST-9 (Rosten and Drummond 2006), the best score among its 8 neighbours, row by row. Cells without any
/// corner are searched again with the lower threshold.
[[nodiscard]] std::vector<Corner> detect_fast(const GrayImage& image, const FastOptions& options = {},
                                              const Executor& executor = Executor());

/// Harris' measure (Harris and Stephens 1988) in a window of 7x7: determinant - 0.04 trace^2 of the structure
/// tensor of gradients in [-1, 1]. The larger, the better the pixel can be located. It is at least 5 pixels
/// inside the image.
[[nodiscard]] float harris_measure(const GrayImage& image, int u, int v);

}  // namespace cairn
