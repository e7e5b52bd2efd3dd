// SPDX-License-Identifier: Apache-2.0
#include "cairn/features/uniform_selection.h"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

constexpr double kPointsPerCell = 20;  // on average: few enough for cells to be small, enough to choose from
constexpr double kGranted = 0.5;       // of these, to each cell; the rest goes by strength

/// Cells of the image, about square.
class Grid {
 public:
  Grid(int width, int height, double cells)
      : width_(width),
        height_(height),
        columns_(at_least_one(std::sqrt(cells * width / height))),
        rows_(at_least_one(cells / static_cast<double>(columns_))) {}
  [[nodiscard]] std::size_t count() const { return columns_ * rows_; }
  [[nodiscard]] std::size_t cell_of(const PixelPosition& place) const {
    return index(static_cast<double>(place.v) / height_, rows_) * columns_ +
           index(static_cast<double>(place.u) / width_, columns_);
  }

 private:
  static std::size_t at_least_one(double number) {
    return static_cast<std::size_t>(std::max(1L, std::lround(number)));
  }
  static std::size_t index(double share, std::size_t cells) {
    return std::min(cells - 1, static_cast<std::size_t>(share * static_cast<double>(cells)));
  }

  int width_, height_;
  std::size_t columns_, rows_;
};

/// Marks the strongest `granted` of each cell; how many these are.
std::size_t grant(const Grid& grid, const std::vector<PixelPosition>& places, std::size_t granted,
                  std::vector<bool>& kept) {
  std::vector<std::size_t> taken(grid.count());
  std::size_t total = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    std::size_t& in_cell = taken[grid.cell_of(places[i])];
    if (in_cell == granted) continue;
    ++in_cell;
    ++total;
    kept[i] = true;
  }
  return total;
}

}  // namespace

std::vector<std::size_t> select_uniform(const std::vector<PixelPosition>& places, int width, int height,
                                        std::size_t count) {
  std::vector<bool> kept(places.size(), places.size() <= count);
  std::size_t total = std::min(places.size(), count);
  if (places.size() > count) {
    const Grid grid(width, height, static_cast<double>(count) / kPointsPerCell);
    total = grant(
        grid, places,
        static_cast<std::size_t>(kGranted * static_cast<double>(count) / static_cast<double>(grid.count())),
        kept);
  }
  std::vector<std::size_t> selected;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!kept[i] && total == count) continue;
    if (!kept[i]) ++total;
    selected.push_back(i);
  }
  return selected;
}

}  // namespace cairn
