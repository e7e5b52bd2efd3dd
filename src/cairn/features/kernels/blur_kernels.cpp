// SPDX-License-Identifier: Apache-2.0
#include "cairn/features/kernels/blur_kernels.h"

#include "cairn/features/kernels/lanes.h"

namespace cairn::CAIRN_ISA {
namespace {

/// Several vectors at a time: their sums do not wait for each other.
template <int vectors>
void sum_block(const float* const* first, const float* const* second, const float* weights, int pairs, int x,
               float* out) {
  Lanes sum[vectors];
  for (int i = 0; i < vectors; ++i)
    sum[i] = spread(weights[0]) * (load(first[0] + x + i * kLanes) + load(second[0] + x + i * kLanes));
  for (int k = 1; k < pairs; ++k) {
    const Lanes weight = spread(weights[k]);
    for (int i = 0; i < vectors; ++i)
      sum[i] = sum[i] + weight * (load(first[k] + x + i * kLanes) + load(second[k] + x + i * kLanes));
  }
  for (int i = 0; i < vectors; ++i) store(out + x + i * kLanes, sum[i]);
}

template <int vectors>
void blur_block(const float* in, const float* weights, int radius, float* out) {
  Lanes sum[vectors];
  for (int i = 0; i < vectors; ++i) sum[i] = spread(weights[0]) * load(in + i * kLanes);
  for (int k = 1; k <= radius; ++k) {
    const Lanes weight = spread(weights[k]);
    for (int i = 0; i < vectors; ++i)
      sum[i] = sum[i] + weight * (load(in + i * kLanes - k) + load(in + i * kLanes + k));
  }
  for (int i = 0; i < vectors; ++i) store(out + i * kLanes, sum[i]);
}

constexpr int kVectors = 4;

void sum_rows(const float* const* first, const float* const* second, const float* weights, int pairs,
              int count, float* out) {
  int x = 0;
  for (; x + kVectors * kLanes <= count; x += kVectors * kLanes)
    sum_block<kVectors>(first, second, weights, pairs, x, out);
  for (; x < count; x += kLanes) sum_block<1>(first, second, weights, pairs, x, out);
}

void blur_row(const float* in, const float* weights, int radius, int count, float* out) {
  int x = 0;
  for (; x + kVectors * kLanes <= count; x += kVectors * kLanes)
    blur_block<kVectors>(in + x, weights, radius, out + x);
  for (; x < count; x += kLanes) blur_block<1>(in + x, weights, radius, out + x);
}

}  // namespace

extern const BlurKernels kBlurKernels;
const BlurKernels kBlurKernels{sum_rows, blur_row};

}  // namespace cairn::CAIRN_ISA
