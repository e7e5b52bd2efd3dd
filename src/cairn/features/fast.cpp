// SPDX-License-Identifier: Apache-2.0
#include "cairn/features/fast.h"

#include <algorithm>

#include "cairn/features/kernels/corner_kernels.h"

namespace cairn {
namespace {

/// Rectangle of pixels, ends excluded.
struct Area {
  int u_begin, u_end, v_begin, v_end;
};

/// One row of cells: its corners with scores, then those that are best among their neighbours.
class CellRow {
 public:
  CellRow(const GrayImage& image, const FastOptions& options, const Area& area)
      : image_(image),
        options_(options),
        area_(area),
        width_(static_cast<std::size_t>(image.width())),
        found_(width_),
        scores_(width_ * static_cast<std::size_t>(area.v_end - area.v_begin + 2)) {}

  std::vector<Corner> detect() {
    search(area_, options_.threshold);
    if (options_.retry_threshold < options_.threshold) search_empty_cells();
    // The rows above and below belong to others; their corners count here as neighbours only.
    search({area_.u_begin, area_.u_end, std::max(area_.v_begin - 1, options_.border), area_.v_begin},
           options_.threshold);
    search({area_.u_begin, area_.u_end, area_.v_end,
            std::min(area_.v_end + 1, image_.height() - options_.border)},
           options_.threshold);
    return best_of_neighbours();
  }

 private:
  std::uint8_t* scores_of_row(int v) {
    return scores_.data() + width_ * static_cast<std::size_t>(v - area_.v_begin + 1);
  }

  bool search(const Area& area, int threshold) {
    bool any = false;
    for (int v = area.v_begin; v < area.v_end; ++v) {
      const int count = corner_kernels().find_fast(image_.row(v), image_.width(), area.u_begin, area.u_end,
                                                   threshold, found_.data());
      std::uint8_t* scores = scores_of_row(v);
      for (int i = 0; i < count; ++i) {
        const std::int32_t u = found_[static_cast<std::size_t>(i)];
        scores[u] = static_cast<std::uint8_t>(corner_kernels().fast_score(image_.row(v) + u, image_.width()));
      }
      any = any || count > 0;
    }
    return any;
  }

  void search_empty_cells() {
    for (int u = area_.u_begin; u < area_.u_end; u += options_.cell) {
      const Area cell{u, std::min(u + options_.cell, area_.u_end), area_.v_begin, area_.v_end};
      if (!has_corner(cell)) search(cell, options_.retry_threshold);
    }
  }

  bool has_corner(const Area& cell) {
    for (int v = cell.v_begin; v < cell.v_end; ++v) {
      const std::uint8_t* scores = scores_of_row(v);
      if (std::any_of(scores + cell.u_begin, scores + cell.u_end, [](std::uint8_t s) { return s > 0; }))
        return true;
    }
    return false;
  }

  /// Of two equal neighbours the first in reading order stays.
  bool is_best(const std::uint8_t* score) const {
    const auto w = static_cast<std::ptrdiff_t>(width_);
    const int s = *score;
    return s > score[-w - 1] && s > score[-w] && s > score[-w + 1] && s > score[-1] && s >= score[1] &&
           s >= score[w - 1] && s >= score[w] && s >= score[w + 1];
  }

  std::vector<Corner> best_of_neighbours() {
    std::vector<Corner> corners;
    for (int v = area_.v_begin; v < area_.v_end; ++v) {
      const std::uint8_t* scores = scores_of_row(v);
      for (int u = area_.u_begin; u < area_.u_end; ++u)
        if (scores[u] > 0 && is_best(scores + u)) corners.push_back({u, v, scores[u], harris(u, v)});
    }
    return corners;
  }

  /// Harris and Stephens 1988: determinant - 0.04 trace^2 of the structure tensor, per pixel and Sobel's
  /// factor.
  [[nodiscard]] float harris(int u, int v) const {
    constexpr double kTraceFactor = 0.04;
    constexpr double kUnit = 1.0 / (4.0 * 7 * 7 * 255);  // gradients in [-1, 1], mean over the window
    std::int32_t sums[3];
    corner_kernels().structure_tensor(image_.row(v) + u, image_.width(), sums);
    const double xx = sums[0] * kUnit, xy = sums[1] * kUnit, yy = sums[2] * kUnit;
    return static_cast<float>(xx * yy - xy * xy - kTraceFactor * (xx + yy) * (xx + yy));
  }

  const GrayImage& image_;
  const FastOptions& options_;
  Area area_;
  std::size_t width_;
  std::vector<std::int32_t> found_;
  std::vector<std::uint8_t> scores_;  // 0: no corner; one row more above and below
};

}  // namespace

std::vector<Corner> detect_fast(const GrayImage& image, const FastOptions& options,
                                const Executor& executor) {
  constexpr int kReach = 4;  // pixels that the kernels read around a corner
  require(options.threshold >= 1 && options.threshold <= 254 && options.retry_threshold >= 1 &&
              options.retry_threshold <= options.threshold && options.cell >= 1 && options.border >= kReach,
          "FAST's options are in their ranges");
  const Area inside{options.border, image.width() - options.border, options.border,
                    image.height() - options.border};
  if (inside.u_begin >= inside.u_end || inside.v_begin >= inside.v_end) return {};
  const int rows = (inside.v_end - inside.v_begin + options.cell - 1) / options.cell;
  const auto corners_of_rows =
      executor.map<std::vector<Corner>>(static_cast<std::size_t>(rows), [&](std::size_t i) {
        const int v = inside.v_begin + static_cast<int>(i) * options.cell;
        return CellRow(image, options,
                       {inside.u_begin, inside.u_end, v, std::min(v + options.cell, inside.v_end)})
            .detect();
      });
  std::vector<Corner> corners;
  for (const auto& row : corners_of_rows) corners.insert(corners.end(), row.begin(), row.end());
  return corners;
}

}  // namespace cairn
