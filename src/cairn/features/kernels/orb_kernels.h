// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "cairn/simd/dispatch.h"

namespace cairn {

constexpr int kMomentRadius = 15;  ///< pixels: the disc whose moments give a keypoint's angle
constexpr int kBriefBits = 256;

/// Pairs of places that BRIEF compares, relative to the keypoint, before rotation.
struct BriefPattern {
  float u[2 * kBriefBits];  ///< first places of all pairs, then the second ones
  float v[2 * kBriefBits];
};

struct OrbKernels {
  /// m10 = sum of u I(u, v), m01 = sum of v I(u, v) over the disc u^2 + v^2 <= radius^2 around the pixel. The
  /// square of 32 columns and 31 rows around it is read.
  void (*moments)(const std::uint8_t* pixel, std::ptrdiff_t stride, std::int32_t* m10, std::int32_t* m01);
  /// Bit i of `bits` = I(first of pair i) < I(second), places turned by the angle and rounded to pixels,
  /// at most 18 from the pixel; that and one more column and row around it are read.
  void (*brief)(const std::uint8_t* pixel, std::ptrdiff_t stride, const BriefPattern& pattern, float cosine,
                float sine, std::uint8_t* bits);
};

CAIRN_KERNEL_TABLES(OrbKernels, kOrbKernels)

/// The kernels for `set`, which is available.
[[nodiscard]] inline const OrbKernels& orb_kernels(InstructionSet set = default_instruction_set()) {
  return CAIRN_CHOOSE_KERNELS(set, kOrbKernels);
}

}  // namespace cairn
