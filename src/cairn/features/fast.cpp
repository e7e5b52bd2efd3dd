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
        scores_(width_ * static_cast<std::size_t>(area.v_end - area.v_begin + 2) + kReadAhead) {}

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
      const bool found = corner_kernels().score_fast(image_.row(v), image_.width(), image_.width(),
                                                     area.u_begin, area.u_end, threshold, scores_of_row(v));
      any = any || found;
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
    std::uint8_t any = 0;
    for (int v = cell.v_begin; v < cell.v_end; ++v) {
      const std::uint8_t* scores = scores_of_row(v);
      for (int u = cell.u_begin; u < cell.u_end; ++u) any |= scores[u];
    }
    return any > 0;
  }

  std::vector<Corner> best_of_neighbours() {
    std::vector<Corner> corners;
    for (int v = area_.v_begin; v < area_.v_end; ++v) {
      const std::uint8_t* scores = scores_of_row(v);
      const int count =
          corner_kernels().find_peaks(scores, image_.width(), area_.u_begin, area_.u_end, found_.data());
      for (int i = 0; i < count; ++i) {
        const std::int32_t u = found_[static_cast<std::size_t>(i)];
        corners.push_back({u, v, scores[u]});
      }
    }
    return corners;
  }

  static constexpr std::size_t kReadAhead = 65;  // bytes behind the last score that find_peaks may read

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

float harris_measure(const GrayImage& image, int u, int v) {
  constexpr double kTraceFactor = 0.04;
  constexpr double kUnit =
      1.0 / (16.0 * 7 * 7 * 255 * 255);  // Sobel's factor 4 and 255 grey levels, squared; mean
  std::int32_t sums[3];
  corner_kernels().structure_tensor(image.row(v) + u, image.width(), sums);
  const double xx = sums[0] * kUnit, xy = sums[1] * kUnit, yy = sums[2] * kUnit;
  return static_cast<float>(xx * yy - xy * xy - kTraceFactor * (xx + yy) * (xx + yy));
}

}  // namespace cairn
