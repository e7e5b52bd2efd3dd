// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "cairn/features/features.h"
#include "cairn/matching/kernels/distance_kernels.h"

namespace cairn {

/// A copy of descriptors in the kernels' layout: groups of 16 side by side, the last one filled up.
class PackedDescriptors {
 public:
  explicit PackedDescriptors(const Descriptors& descriptors);
  /// Place i holds row order[i].
  PackedDescriptors(const Descriptors& descriptors, std::span<const std::int32_t> order);

  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] std::size_t groups() const { return (count_ + kPackedLanes - 1) / kPackedLanes; }
  [[nodiscard]] std::size_t bytes_per_group() const { return kPackedLanes * 4 * words_; }

  /// Distances (of the kernels: bits, or squares for L2) of rows [first, first + rows) of `query`, which is
  /// of the same kind, to groups [first_group, first_group + groups): row first + r to place 16 first_group +
  /// t at distances[r * 16 * groups + t]; kNoDistance where no descriptor is.
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

/// The kernels for a norm on this processor.
[[nodiscard]] const DistanceKernels& distance_kernels(Norm norm);

/// What the kernels measure as Match::distance: bits, or the root of the square.
[[nodiscard]] float match_distance(Norm norm, std::int32_t measured);

/// PreconditionError unless the two can be compared: same norm and length, L2 of at most 32 KiB.
void require_comparable(const Descriptors& a, const Descriptors& b);

}  // namespace cairn
