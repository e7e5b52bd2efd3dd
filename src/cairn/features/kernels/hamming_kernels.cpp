// SPDX-License-Identifier: Apache-2.0
#include "cairn/features/kernels/hamming_kernels.h"

namespace cairn::CAIRN_ISA {
namespace {

void distances(const std::uint64_t* query, const std::uint64_t* trains, std::size_t count, std::size_t words,
               std::uint32_t* distances) {
  for (std::size_t t = 0; t < count; ++t) {
    const std::uint64_t* train = trains + t * words;
    int bits = 0;
    for (std::size_t w = 0; w < words; ++w) bits += __builtin_popcountll(query[w] ^ train[w]);
    distances[t] = static_cast<std::uint32_t>(bits);
  }
}

}  // namespace

extern const HammingKernels kHammingKernels;
const HammingKernels kHammingKernels{distances};

}  // namespace cairn::CAIRN_ISA
