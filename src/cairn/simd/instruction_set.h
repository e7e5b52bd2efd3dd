// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace cairn {

/// Names an instruction set. Kernels are compiled once per set, from one source, and chosen at run time.
/// Every set gives the same bits: integers, or floats added and multiplied in one order and never contracted.
enum class InstructionSet {
  plain,   ///< what every machine of the architecture has
  sse42,   ///< SSE4.2 and POPCNT
  avx2,    ///< AVX2, BMI1 and BMI2; no FMA, which would change bits
  avx512,  ///< AVX-512 F, BW, VL, DQ, VBMI, VNNI, BITALG and VPOPCNTDQ, as since Ice Lake and Zen 4
};

/// Returns the highest set that this build holds and this processor has, or the one that the environment
/// variable CAIRN_SIMD names (plain, sse4.2, avx2, avx512). Throws InputError if that is none of them or not
/// available.
[[nodiscard]] InstructionSet default_instruction_set();

}  // namespace cairn
