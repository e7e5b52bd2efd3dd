// SPDX-License-Identifier: Apache-2.0
#include "cairn/features/kernels/hamming_kernels.h"

#include <bit>

#include "cairn/features/kernels/test_kernels.h"

namespace cairn {
namespace {

using HammingKernelsTest = EachInstructionSet;

TEST_P(HammingKernelsTest, counts_the_bits_that_differ) {
  Random random(1, 0);
  for (const std::size_t words : {1, 4, 8}) {
    for (const std::size_t count : {0, 1, 7, 64, 1001}) {
      std::vector<std::uint64_t> query(words), trains(count * words);
      for (auto& word : query) word = random.next();
      for (auto& word : trains) word = random.next();
      std::vector<std::uint32_t> distances(count);
      hamming_kernels(GetParam()).distances(query.data(), trains.data(), count, words, distances.data());
      for (std::size_t t = 0; t < count; ++t) {
        int bits = 0;
        for (std::size_t w = 0; w < words; ++w) bits += std::popcount(query[w] ^ trains[t * words + w]);
        ASSERT_EQ(distances[t], static_cast<std::uint32_t>(bits));
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Sets, HammingKernelsTest, testing::ValuesIn(available_instruction_sets()),
                         name_of_parameter);

}  // namespace
}  // namespace cairn
