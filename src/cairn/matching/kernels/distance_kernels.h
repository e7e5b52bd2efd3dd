// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

namespace cairn {

/// Number of descriptors side by side in a group of packed ones, so that one instruction works on several.
inline constexpr std::size_t kPackedLanes = 16;

/// Describes queries to be compared with groups of packed descriptors. Word w (32 bits) of packed descriptor
/// 16 g + lane is packed[(g * words + w) * 16 + lane].
struct DistanceTile {
  const std::uint8_t* queries = nullptr;  ///< one after the other, 4 * words bytes each
  std::size_t query_count = 0;
  std::size_t words = 0;  ///< of 32 bits, of one descriptor
  /// The groups, groups * words * 16 in all; for L2 the top bit of every byte is flipped.
  const std::uint32_t* packed = nullptr;
  const std::int32_t* squares = nullptr;  ///< L2: sum of the squared bytes of each packed one; else unused
  std::size_t groups = 0;
  std::int32_t* distances = nullptr;  ///< result: query q to packed t at distances[q * 16 * groups + t]
};

/// Describes one query to be compared with rows of unpacked descriptors.
struct DistanceList {
  const std::uint8_t* query = nullptr;
  const std::uint8_t* rows = nullptr;  ///< row i begins at 8 * words64 * i
  std::size_t words64 = 0;             ///< of 64 bits, of one descriptor
  const std::int32_t* indices = nullptr;
  std::size_t count = 0;
  std::int32_t* distances = nullptr;  ///< result: to row indices[k] at distances[k]
};

/// Lists the kernels of one norm and one instruction set. Distances are exact integers below 2^31: the number
/// of bits that differ, or the squared Euclidean distance of bytes.
struct DistanceKernels {
  void (*to_packed)(const DistanceTile& tile);
  void (*to_rows)(const DistanceList& list);
};

}  // namespace cairn
