// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "cairn/features/features.h"

namespace cairn {

/// Finds the keypoints around a place without looking at all. Keypoints that are not finite are in no place.
class KeypointGrid {
 public:
  /// `keypoints` must outlive the grid.
  explicit KeypointGrid(const std::vector<Keypoint>& keypoints);

  /// Appends the indices of the keypoints at most `radius_px` from (u, v), in no meaningful but always the
  /// same order. Nothing for a place or a radius that is no number or negative.
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
