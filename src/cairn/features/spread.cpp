// SPDX-License-Identifier: Apache-2.0
#include "cairn/features/spread.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace cairn {
namespace {

/// Square cells over the image.
class Cells {
 public:
  Cells(int width, int height, double wanted)
      : side_(std::max(1.0, std::sqrt(static_cast<double>(width) * height / wanted))),
        columns_(static_cast<int>(std::ceil(width / side_))),
        rows_(static_cast<int>(std::ceil(height / side_))) {}

  [[nodiscard]] std::size_t count() const {
    return static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
  }
  [[nodiscard]] std::size_t of(const Candidate& candidate) const {
    const int column =
        std::clamp(static_cast<int>(static_cast<double>(candidate.u) / side_), 0, columns_ - 1);
    const int row = std::clamp(static_cast<int>(static_cast<double>(candidate.v) / side_), 0, rows_ - 1);
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }

 private:
  double side_;
  int columns_, rows_;
};

}  // namespace

std::vector<std::int32_t> select_spread(std::span<const Candidate> candidates, int count, int width,
                                        int height, double crowding) {
  std::vector<std::int32_t> order(candidates.size());
  std::iota(order.begin(), order.end(), 0);
  const auto wanted = static_cast<std::size_t>(std::max(count, 0));
  if (candidates.size() <= wanted) return order;
  const auto strength = [&](std::int32_t i) { return candidates[static_cast<std::size_t>(i)].strength; };
  std::sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
    return strength(a) != strength(b) ? strength(a) > strength(b) : a < b;
  });
  constexpr double kPerCell = 5;  // fewer would leave too little to choose from in a cell
  const Cells cells(width, height, std::max(1.0, count / kPerCell));
  const int quota = static_cast<int>(std::ceil(crowding * count / static_cast<double>(cells.count())));
  std::vector<int> taken(cells.count());
  std::vector<std::int32_t> chosen, rest;
  for (const std::int32_t i : order) {
    int& used = taken[cells.of(candidates[static_cast<std::size_t>(i)])];
    (chosen.size() < wanted && used < quota ? chosen : rest).push_back(i);
    ++used;
  }
  for (std::size_t i = 0; chosen.size() < wanted; ++i) chosen.push_back(rest[i]);
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

}  // namespace cairn
