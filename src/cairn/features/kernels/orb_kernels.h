// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "cairn/simd/dispatch.h"

namespace cairn {

constexpr int kMomentRadius = 15;  ///< pixels: the disc whose moments give a keypoint's angle
constexpr int kBriefBits = 256;

/// Holds the pairs of positions that BRIEF compares, relative to the keypoint, before rotation.
struct BriefPattern {
  float u[2 * kBriefBits];  ///< first positions of all pairs, then the second ones
  float v[2 * kBriefBits];
};

/// Lists the kernels of one instruction set.
struct OrbKernels {
  /// Computes the moments m10 = sum of u I(u, v) and m01 = sum of v I(u, v) over the disc u^2 + v^2 <=
  /// radius^2 around the pixel. Reads the square of 32 columns and 31 rows around it.
  void (*moments)(const std::uint8_t* pixel, std::ptrdiff_t stride, std::int32_t* m10, std::int32_t* m01);
  /// Computes the descriptor: bit i of `bits` = I(first of pair i) < I(second), with positions rotated by the
  /// angle and rounded to pixels, at most 18 from the pixel; reads these and one more column and row around
  /// them.
  void (*brief)(const std::uint8_t* pixel, std::ptrdiff_t stride, const BriefPattern& pattern, float cosine,
                float sine, std::uint8_t* bits);
};

CAIRN_KERNEL_TABLES(OrbKernels, kOrbKernels)

/// Returns the kernels for `set`, which must be available.
[[nodiscard]] inline const OrbKernels& orb_kernels(InstructionSet set = default_instruction_set()) {
  return CAIRN_CHOOSE_KERNELS(set, kOrbKernels);
}

}  // namespace cairn
