// SPDX-License-Identifier: Apache-2.0
#include "cairn/features/kernels/extrema_kernels.h"

#include "cairn/simd/float_lanes.h"

namespace cairn::CAIRN_ISA {
namespace {

/// Smallest and largest of D so far.
struct Range {
  Lanes low, high;

  void include(Lanes value) {
    low = smaller(low, value);
    high = larger(high, value);
  }
};

/// D between two levels, in one row.
struct DifferenceRow {
  const float *finer, *coarser;

  [[nodiscard]] Lanes at(int x) const { return load(coarser + x) - load(finer + x); }
};

/// Of the 9 values of D between `level` and the next around x, with `centre` among or beside them.
Range range_around(const GaussianRows& gaussians, int level, int x, Lanes centre) {
  Range range{centre, centre};
  for (int row = 0; row < 3; ++row) {
    const DifferenceRow difference{gaussians.rows[level][row], gaussians.rows[level + 1][row]};
    for (int dx = -1; dx <= 1; ++dx) range.include(difference.at(x + dx));
  }
  return range;
}

/// Bit l says whether x + l is an extremum. Most vectors are done with after the threshold or the middle
/// level.
unsigned extrema_at(const GaussianRows& gaussians, int x, Lanes threshold) {
  constexpr int kOrder[] = {1, 0, 2};
  const Lanes centre = DifferenceRow{gaussians.rows[1][1], gaussians.rows[2][1]}.at(x);
  unsigned maxima = at_least(centre, threshold), minima = at_least(broadcast(0.0F) - threshold, centre);
  if ((maxima | minima) == 0) return 0;
  const Lanes finer = DifferenceRow{gaussians.rows[0][1], gaussians.rows[1][1]}.at(x);
  const Lanes coarser = DifferenceRow{gaussians.rows[2][1], gaussians.rows[3][1]}.at(x);
  maxima &= at_least(centre, larger(finer, coarser));
  minima &= at_least(smaller(finer, coarser), centre);
  for (const int level : kOrder) {
    if ((maxima | minima) == 0) return 0;
    const Range range = range_around(gaussians, level, x, centre);
    maxima &= at_least(centre, range.high);
    minima &= at_least(range.low, centre);
  }
  return maxima | minima;
}

int find(const GaussianRows& gaussians, int begin, int end, float threshold, int* found) {
  const Lanes thresholds = broadcast(threshold);
  int count = 0;
  for (int x = begin / kLanes * kLanes; x < end; x += kLanes) {  // rows begin at cache lines
    for (unsigned bits = extrema_at(gaussians, x, thresholds); bits != 0; bits &= bits - 1) {
      const int column = x + __builtin_ctz(bits);
      if (column >= begin && column < end) found[count++] = column;
    }
  }
  return count;
}

}  // namespace

extern const ExtremaKernels kExtremaKernels;
const ExtremaKernels kExtremaKernels{find};

}  // namespace cairn::CAIRN_ISA
