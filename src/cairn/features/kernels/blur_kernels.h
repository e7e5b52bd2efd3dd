// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "cairn/simd/dispatch.h"

namespace cairn {

/// Lists the kernels of one instruction set: symmetric filters of rows of floats. Columns are processed in
/// steps of kBlurStep.
struct BlurKernels {
  /// Filters along columns: out[x] = sum over k < pairs of weights[k] (rows[-k][x] + rows[k + shift][x]) for
  /// x in [begin, end), around row 0, or between rows 0 and 1 if `shift` is 1.
  void (*sum_rows)(const float* const* rows, int shift, const float* weights, int pairs, int begin, int end,
                   float* out);
  /// Filters along a row: out[x] = weights[0] in[x] + sum over 1 <= k <= radius of weights[k] (in[x - k] +
  /// in[x + k]); `in` continues for `radius` floats on both sides.
  void (*blur_row)(const float* in, const float* weights, int radius, int count, float* out);
};

constexpr int kBlurStep = 16;  ///< floats, the widest vector

CAIRN_KERNEL_TABLES(BlurKernels, kBlurKernels)

/// Returns the kernels for `set`, which must be available.
[[nodiscard]] inline const BlurKernels& blur_kernels(InstructionSet set = default_instruction_set()) {
  return CAIRN_CHOOSE_KERNELS(set, kBlurKernels);
}

}  // namespace cairn
