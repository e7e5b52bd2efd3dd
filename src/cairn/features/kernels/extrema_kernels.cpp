// SPDX-License-Identifier: Apache-2.0
#include "cairn/features/kernels/extrema_kernels.h"

#include "cairn/features/kernels/lanes.h"

namespace cairn::CAIRN_ISA {
namespace {

/// Lanes that are not below, and lanes that are not above, what they have been compared with so far.
struct Candidates {
  unsigned maxima, minima;

  [[nodiscard]] bool none() const { return (maxima | minima) == 0; }
  void compare(Lanes centre, Lanes low, Lanes high) {
    maxima &= at_least(centre, high);
    minima &= at_least(low, centre);
  }
};

/// With the row's values left, at and right of x.
void compare_row(Candidates& candidates, Lanes centre, const float* row, int x) {
  const Lanes left = load(row + x - 1), middle = load(row + x), right = load(row + x + 1);
  candidates.compare(centre, smaller(smaller(left, middle), right), larger(larger(left, middle), right));
}

constexpr int kLevelOrder[] = {1, 0, 2};

/// Bit l says whether x + l is an extremum. Most vectors are done with after the middle level.
unsigned extrema_at(const DifferenceRows& differences, int x, Lanes threshold) {
  const Lanes centre = load(differences.rows[1][1] + x);
  Candidates candidates{at_least(centre, threshold), at_least(spread(0.0F) - threshold, centre)};
  for (const int level : kLevelOrder) {
    for (int row = 0; row < 3; ++row) {
      if (candidates.none()) return 0;
      compare_row(candidates, centre, differences.rows[level][row], x);
    }
  }
  return candidates.maxima | candidates.minima;
}

void subtract(const float* a, const float* b, int count, float* out) {
  for (int x = 0; x < count; x += kLanes) store(out + x, load(a + x) - load(b + x));
}

int find(const DifferenceRows& differences, int begin, int end, float threshold, int* found) {
  const Lanes thresholds = spread(threshold);
  int count = 0;
  for (int x = begin; x < end; x += kLanes) {
    for (unsigned bits = extrema_at(differences, x, thresholds); bits != 0; bits &= bits - 1) {
      const int column = x + __builtin_ctz(bits);
      if (column < end) found[count++] = column;
    }
  }
  return count;
}

}  // namespace

extern const ExtremaKernels kExtremaKernels;
const ExtremaKernels kExtremaKernels{subtract, find};

}  // namespace cairn::CAIRN_ISA
