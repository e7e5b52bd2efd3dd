// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "cairn/features/features.h"
#include "cairn/matching/kernels/distance_kernels.h"

namespace cairn {

/// Holds a copy of descriptors in the kernels' layout: groups of 16 side by side, the last one padded.
class PackedDescriptors {
 public:
  /// Packs all rows in their order.
  explicit PackedDescriptors(const Descriptors& descriptors);
  /// Packs row order[i] at position i.
  PackedDescriptors(const Descriptors& descriptors, std::span<const std::int32_t> order);

  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] std::size_t groups() const { return (count_ + kPackedLanes - 1) / kPackedLanes; }
  [[nodiscard]] std::size_t bytes_per_group() const { return kPackedLanes * 4 * words_; }

  /// Measures the distances (of the kernels: bits, or squares for L2) from rows [first, first + rows) of
  /// `query`, which has the same kind, to groups [first_group, first_group + groups): row first + r to
  /// position 16 first_group + t at distances[r * 16 * groups + t], kNoDistance beyond the last descriptor.
  void measure(const Descriptors& query, std::size_t first, std::size_t rows, std::size_t first_group,
               std::size_t groups, std::int32_t* distances) const;

 private:
  void pack(std::size_t place, const std::uint8_t* row, std::uint32_t flipped);

  const DistanceKernels* kernels_;
  std::size_t count_ = 0;
  std::size_t words_ = 0;  // of 32 bits, of one descriptor
  std::vector<std::uint32_t> packed_;
  std::vector<std::int32_t> squares_;
};

/// Returns the kernels for a norm on this processor.
[[nodiscard]] const DistanceKernels& distance_kernels(Norm norm);

/// Converts a distance of the kernels to Match::distance: bits, or the root of the square.
[[nodiscard]] float match_distance(Norm norm, std::int32_t measured);

/// Throws PreconditionError unless the two can be compared: same norm and length, L2 of at most 32 KiB.
void require_comparable(const Descriptors& a, const Descriptors& b);

}  // namespace cairn
