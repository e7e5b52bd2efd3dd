// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "cairn/features/features.h"

namespace cairn {

/// Finds the keypoints around a position without looking at all. Never finds keypoints that are not finite.
class KeypointGrid {
 public:
  /// Sorts `keypoints`, which must outlive the grid, into cells.
  explicit KeypointGrid(const std::vector<Keypoint>& keypoints);

  /// Appends the indices of the keypoints at most `radius_px` from (u, v), always in the same order, which
  /// has no meaning. Appends none if the position is not finite, or the radius is NaN or negative.
  void find(double u, double v, double radius_px, std::vector<std::int32_t>& indices) const;

 private:
  void fill();
  [[nodiscard]] int column_of(double u) const;
  [[nodiscard]] int row_of(double v) const;

  const std::vector<Keypoint>& keypoints_;
  double left_ = 0, top_ = 0;  // of the first cell
  double cells_per_px_u_ = 0, cells_per_px_v_ = 0;
  int columns_ = 1, rows_ = 1;
  std::vector<std::int32_t> begins_;  // of each cell in indices_, row by row, and the end of the last
  std::vector<std::int32_t> indices_;
};

}  // namespace cairn
