// SPDX-License-Identifier: Apache-2.0
#include "cairn/features/kernels/blur_kernels.h"

#include "cairn/simd/float_lanes.h"

namespace cairn::CAIRN_ISA {
namespace {

/// Several vectors at a time: their sums do not wait for each other.
template <int vectors>
void sum_block(const float* const* rows, int shift, const float* weights, int pairs, int x, float* out) {
  Lanes sum[vectors];
  for (Lanes& value : sum) value = broadcast(0.0F);
  for (int k = 0; k < pairs; ++k) {
    const float *above = rows[-k] + x, *below = rows[k + shift] + x;
    const Lanes weight = broadcast(weights[k]);
    for (int i = 0; i < vectors; ++i)
      sum[i] = sum[i] + weight * (load(above + i * kLanes) + load(below + i * kLanes));
  }
  for (int i = 0; i < vectors; ++i) store(out + x + i * kLanes, sum[i]);
}

template <int vectors>
void blur_block(const float* in, const float* weights, int radius, float* out) {
  Lanes sum[vectors];
  for (int i = 0; i < vectors; ++i) sum[i] = broadcast(weights[0]) * load(in + i * kLanes);
  for (int k = 1; k <= radius; ++k) {
    const Lanes weight = broadcast(weights[k]);
    for (int i = 0; i < vectors; ++i)
      sum[i] = sum[i] + weight * (load(in + i * kLanes - k) + load(in + i * kLanes + k));
  }
  for (int i = 0; i < vectors; ++i) store(out + i * kLanes, sum[i]);
}

constexpr int kVectors = 4;

void sum_rows(const float* const* rows, int shift, const float* weights, int pairs, int begin, int end,
              float* out) {
  int x = begin;
  for (; x + kVectors * kLanes <= end; x += kVectors * kLanes)
    sum_block<kVectors>(rows, shift, weights, pairs, x, out);
  for (; x < end; x += kLanes) sum_block<1>(rows, shift, weights, pairs, x, out);
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
