// SPDX-License-Identifier: Apache-2.0
#include "cairn/matching/kernels/distance_kernels.h"

#include <gtest/gtest.h>

#include <bit>

#include "cairn/core/random.h"
#include "cairn/matching/kernels/hamming_kernels.h"
#include "cairn/matching/kernels/l2_kernels.h"
#include "cairn/simd/available.h"

namespace cairn {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes random_bytes(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  Bytes bytes(count);
  for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random.index(256));
  return bytes;
}

/// The definition, byte by byte.
std::int32_t slow_distance(bool l2, const std::uint8_t* a, const std::uint8_t* b, std::size_t bytes) {
  std::int32_t sum = 0;
  for (std::size_t i = 0; i < bytes; ++i)
    sum += l2 ? (a[i] - b[i]) * (a[i] - b[i]) : std::popcount(static_cast<unsigned>(a[i] ^ b[i]));
  return sum;
}

/// The layout that distance_kernels.h describes, written down byte by byte.
std::vector<std::uint32_t> packed(bool l2, const Bytes& rows, std::size_t words, std::size_t groups) {
  std::vector<std::uint32_t> result(groups * kPackedLanes * words);
  auto* bytes = reinterpret_cast<std::uint8_t*>(result.data());
  for (std::size_t t = 0; t < groups * kPackedLanes; ++t)
    for (std::size_t i = 0; i < 4 * words; ++i)
      bytes[4 * ((t / 16 * words + i / 4) * 16 + t % 16) + i % 4] =
          static_cast<std::uint8_t>(rows[t * 4 * words + i] ^ (l2 ? 0x80 : 0));
  return result;
}

struct Case {
  InstructionSet set;
  bool l2;
};

class DistanceKernelsTest : public testing::TestWithParam<Case> {
 protected:
  [[nodiscard]] static bool l2() { return GetParam().l2; }
  [[nodiscard]] static const DistanceKernels& kernels() {
    return l2() ? l2_kernels(GetParam().set) : hamming_kernels(GetParam().set);
  }
  [[nodiscard]] static std::vector<std::int32_t> measure(const Bytes& queries, const Bytes& rows,
                                                         std::size_t words, std::size_t groups) {
    const auto layout = packed(l2(), rows, words, groups);
    const Bytes zeros(4 * words);
    std::vector<std::int32_t> squares, distances(queries.size() / (4 * words) * groups * kPackedLanes, -1);
    for (std::size_t t = 0; t < groups * kPackedLanes; ++t)
      squares.push_back(slow_distance(true, rows.data() + t * 4 * words, zeros.data(), 4 * words));
    DistanceTile tile;
    tile.queries = queries.data(), tile.query_count = queries.size() / (4 * words), tile.words = words;
    tile.packed = layout.data(), tile.squares = squares.data(), tile.groups = groups;
    tile.distances = distances.data();
    kernels().to_packed(tile);
    return distances;
  }
};

TEST_P(DistanceKernelsTest, to_packed_is_the_definition) {
  for (const std::size_t words : {2U, 8U, 16U, 32U, 34U, 70U}) {
    for (const std::size_t queries : {1U, 3U, 4U, 9U}) {
      for (const std::size_t groups : {1U, 3U, 4U, 7U}) {
        const std::size_t bytes = 4 * words, columns = groups * kPackedLanes;
        const Bytes a = random_bytes(queries * bytes, words + queries),
                    b = random_bytes(columns * bytes, groups);
        const auto distances = measure(a, b, words, groups);
        for (std::size_t q = 0; q < queries; ++q)
          for (std::size_t t = 0; t < columns; ++t)
            ASSERT_EQ(distances[q * columns + t],
                      slow_distance(l2(), a.data() + q * bytes, b.data() + t * bytes, bytes))
                << words << " words, query " << q << " of " << queries << ", place " << t << " of "
                << columns;
      }
    }
  }
}

TEST_P(DistanceKernelsTest, extreme_bytes_do_not_overflow) {
  for (const std::size_t words : {8UL, 64UL, 8192UL}) {
    const std::size_t bytes = 4 * words;
    for (const auto& [a, b] :
         {std::pair(0, 255), std::pair(255, 0), std::pair(255, 255), std::pair(127, 128)}) {
      const Bytes query(bytes, static_cast<std::uint8_t>(a)), rows(16 * bytes, static_cast<std::uint8_t>(b));
      for (const std::int32_t distance : measure(query, rows, words, 1))
        ASSERT_EQ(distance, slow_distance(l2(), query.data(), rows.data(), bytes))
            << words << ' ' << a << ' ' << b;
    }
  }
}

TEST_P(DistanceKernelsTest, to_rows_is_the_definition) {
  for (const std::size_t words64 : {1U, 4U, 8U, 16U, 17U}) {
    const std::size_t bytes = 8 * words64, rows = 50;
    const Bytes query = random_bytes(bytes, 1), all = random_bytes(rows * bytes, 2);
    for (const std::size_t count : {0U, 1U, 7U}) {
      std::vector<std::int32_t> indices, distances(count + 1, -1);
      for (std::size_t k = 0; k < count; ++k)
        indices.push_back(static_cast<std::int32_t>((k * 37 + 5) % rows));
      DistanceList list;
      list.query = query.data(), list.rows = all.data(), list.words64 = words64;
      list.indices = indices.data(), list.count = count, list.distances = distances.data();
      kernels().to_rows(list);
      for (std::size_t k = 0; k < count; ++k)
        ASSERT_EQ(distances[k],
                  slow_distance(l2(), query.data(), all.data() + static_cast<std::size_t>(indices[k]) * bytes,
                                bytes));
      EXPECT_EQ(distances[count], -1);  // nothing is written behind the last
    }
  }
}

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (const InstructionSet set : available_instruction_sets()) {
    cases.push_back({set, false});
    cases.push_back({set, true});
  }
  return cases;
}

INSTANTIATE_TEST_SUITE_P(Sets, DistanceKernelsTest, testing::ValuesIn(all_cases()), [](const auto& param) {
  return (param.param.l2 ? "l2_set" : "hamming_set") + std::to_string(static_cast<int>(param.param.set));
});

}  // namespace
}  // namespace cairn
