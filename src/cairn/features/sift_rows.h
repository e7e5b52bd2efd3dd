// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "cairn/core/executor.h"
#include "cairn/features/aligned_floats.h"
#include "cairn/features/kernels/blur_kernels.h"

/// Rows and levels of floats that the filters of the scale space share.
namespace cairn {

/// Rows that one thread processes at a time: their intermediate rows stay in its cache.
constexpr int kStripRows = 64;

/// Refers to an image of floats owned elsewhere; rows are readable to a multiple of kBlurStep.
struct ScaleLevel {
  float* pixels = nullptr;
  int width = 0, height = 0, stride = 0;

  [[nodiscard]] float* row(int v) const { return pixels + static_cast<std::ptrdiff_t>(v) * stride; }
};

/// Rounds up to the next multiple of `step`.
[[nodiscard]] inline int round_up(int value, int step) {
  return (value + step - 1) / step * step;
}

/// Holds rows with a margin on both sides, into which their outermost values are repeated.
class PaddedRows {
 public:
  PaddedRows(int width, int rows, int margin)
      : width_(width),
        margin_(round_up(margin, kBlurStep)),
        stride_(round_up(width, kBlurStep) + 2 * margin_),
        floats_(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(rows)) {}
  [[nodiscard]] float* row(int v) const {
    return floats_.data() + static_cast<std::ptrdiff_t>(v) * stride_ + margin_;
  }
  /// Fills the margins of a row.
  void pad(int v) {
    float* pixels = row(v);
    std::fill(pixels - margin_, pixels, pixels[0]);
    std::fill(pixels + width_, pixels - margin_ + stride_, pixels[width_ - 1]);
  }

 private:
  int width_, margin_, stride_;
  AlignedFloats floats_;
};

/// Holds pointers to the rows [begin - margin, end + margin) of a level; its border rows repeat outside.
class RowTable {
 public:
  RowTable(const ScaleLevel& level, int begin, int end, int margin) : first_(begin - margin) {
    for (int v = begin - margin; v < end + margin; ++v)
      rows_.push_back(level.row(std::clamp(v, 0, level.height - 1)));
  }
  [[nodiscard]] const float* const* at(int v) const { return rows_.data() + (v - first_); }

 private:
  int first_;
  std::vector<const float*> rows_;
};

/// Calls work(begin, end) for strips of kStripRows rows.
template <class Work>
void for_each_strip(int height, const Executor& executor, const Work& work) {
  executor.for_each_chunk(
      static_cast<std::size_t>(height), kStripRows,
      [&](std::size_t begin, std::size_t end) { work(static_cast<int>(begin), static_cast<int>(end)); });
}

}  // namespace cairn
