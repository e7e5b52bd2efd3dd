// SPDX-License-Identifier: Apache-2.0
#include "cairn/features/keypoint_grid.h"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

constexpr double kCellPx = 16;  // a window of some pixels touches few cells, and a cell has few keypoints
constexpr int kMaxCells = 256;  // along a side, however far apart the keypoints are

bool is_finite(const Keypoint& keypoint) {
  return std::isfinite(keypoint.u) && std::isfinite(keypoint.v);
}

int cells_for(double length) {
  return static_cast<int>(std::clamp(std::ceil(length / kCellPx), 1.0, static_cast<double>(kMaxCells)));
}

int cell_of(double offset, double cells_per_px, int cells) {
  return static_cast<int>(std::clamp(offset * cells_per_px, 0.0, cells - 1.0));
}

}  // namespace

KeypointGrid::KeypointGrid(const std::vector<Keypoint>& keypoints) : keypoints_(keypoints) {
  double right = 0, bottom = 0;
  bool any = false;
  for (const Keypoint& keypoint : keypoints) {
    if (!is_finite(keypoint)) continue;
    const auto u = static_cast<double>(keypoint.u), v = static_cast<double>(keypoint.v);
    left_ = any ? std::min(left_, u) : u, right = any ? std::max(right, u) : u;
    top_ = any ? std::min(top_, v) : v, bottom = any ? std::max(bottom, v) : v;
    any = true;
  }
  columns_ = cells_for(right - left_), rows_ = cells_for(bottom - top_);
  cells_per_px_u_ = columns_ / std::max(right - left_, kCellPx);
  cells_per_px_v_ = rows_ / std::max(bottom - top_, kCellPx);
  fill();
}

/// Counting sort: within a cell, indices ascend.
void KeypointGrid::fill() {
  const auto cell = [&](const Keypoint& keypoint) {
    const auto row = static_cast<std::size_t>(row_of(static_cast<double>(keypoint.v)));
    const auto column = static_cast<std::size_t>(column_of(static_cast<double>(keypoint.u)));
    return row * static_cast<std::size_t>(columns_) + column;
  };
  begins_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) + 1, 0);
  for (const Keypoint& keypoint : keypoints_)
    if (is_finite(keypoint)) ++begins_[cell(keypoint) + 1];
  for (std::size_t i = 1; i < begins_.size(); ++i) begins_[i] += begins_[i - 1];
  indices_.resize(static_cast<std::size_t>(begins_.back()));
  std::vector<std::int32_t> next(begins_.begin(), begins_.end() - 1);
  for (std::size_t i = 0; i < keypoints_.size(); ++i)
    if (is_finite(keypoints_[i]))
      indices_[static_cast<std::size_t>(next[cell(keypoints_[i])]++)] = static_cast<std::int32_t>(i);
}

int KeypointGrid::column_of(double u) const {
  return cell_of(u - left_, cells_per_px_u_, columns_);
}

int KeypointGrid::row_of(double v) const {
  return cell_of(v - top_, cells_per_px_v_, rows_);
}

void KeypointGrid::find(double u, double v, double radius_px, std::vector<std::int32_t>& indices) const {
  if (!std::isfinite(u) || !std::isfinite(v) || !(radius_px >= 0)) return;
  const int first = column_of(u - radius_px), last = column_of(u + radius_px);
  const int last_row = row_of(v + radius_px);
  for (int row = row_of(v - radius_px); row <= last_row; ++row) {
    const std::size_t begin_of_row = static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_);
    const std::int32_t begin = begins_[begin_of_row + static_cast<std::size_t>(first)];
    const std::int32_t end = begins_[begin_of_row + static_cast<std::size_t>(last) + 1];
    for (std::int32_t i = begin; i < end; ++i) {
      const std::int32_t index = indices_[static_cast<std::size_t>(i)];
      const Keypoint& keypoint = keypoints_[static_cast<std::size_t>(index)];
      const double du = static_cast<double>(keypoint.u) - u, dv = static_cast<double>(keypoint.v) - v;
      if (du * du + dv * dv <= radius_px * radius_px) indices.push_back(index);
    }
  }
}

}  // namespace cairn
