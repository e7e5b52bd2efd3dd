// SPDX-License-Identifier: Apache-2.0
#include "cairn/matching/packed_descriptors.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

#include "cairn/matching/kernels/hamming_kernels.h"
#include "cairn/matching/kernels/l2_kernels.h"
#include "cairn/matching/kernels/nearest_kernels.h"

namespace cairn {
namespace {

std::vector<std::int32_t> ascending(std::size_t count) {
  std::vector<std::int32_t> order(count);
  std::iota(order.begin(), order.end(), 0);
  return order;
}

std::int32_t sum_of_squares(const std::uint8_t* row, std::size_t bytes) {
  std::int32_t sum = 0;
  for (std::size_t i = 0; i < bytes; ++i) sum += row[i] * row[i];
  return sum;
}

}  // namespace

PackedDescriptors::PackedDescriptors(const Descriptors& descriptors)
    : PackedDescriptors(descriptors, ascending(descriptors.count())) {}

PackedDescriptors::PackedDescriptors(const Descriptors& descriptors, std::span<const std::int32_t> order)
    : kernels_(&distance_kernels(descriptors.norm())),
      count_(order.size()),
      words_(descriptors.stride() / 4),
      packed_(groups() * kPackedLanes * words_) {
  const bool l2 = descriptors.norm() == Norm::l2;
  const std::uint32_t flipped =
      l2 ? 0x80808080U : 0U;  // bytes less 128, as kernels/l2_kernels.cpp needs them
  if (l2) squares_.resize(groups() * kPackedLanes);
  for (std::size_t place = 0; place < count_; ++place) {
    const std::uint8_t* row = descriptors.row(static_cast<std::size_t>(order[place]));
    pack(place, row, flipped);
    if (l2) squares_[place] = sum_of_squares(row, descriptors.bytes());
  }
}

void PackedDescriptors::pack(std::size_t place, const std::uint8_t* row, std::uint32_t flipped) {
  std::uint32_t* out = packed_.data() + place / kPackedLanes * words_ * kPackedLanes + place % kPackedLanes;
  for (std::size_t w = 0; w < words_; ++w) {
    std::uint32_t word = 0;
    std::memcpy(&word, row + 4 * w, sizeof word);
    out[w * kPackedLanes] = word ^ flipped;
  }
}

void PackedDescriptors::measure(const Descriptors& query, std::size_t first, std::size_t rows,
                                std::size_t first_group, std::size_t groups, std::int32_t* distances) const {
  DistanceTile tile;
  tile.queries = query.row(first);
  tile.query_count = rows;
  tile.words = words_;
  tile.packed = packed_.data() + first_group * kPackedLanes * words_;
  tile.squares = squares_.empty() ? nullptr : squares_.data() + first_group * kPackedLanes;
  tile.groups = groups;
  tile.distances = distances;
  kernels_->to_packed(tile);
  const std::size_t columns = groups * kPackedLanes, real = count_ - first_group * kPackedLanes;
  for (std::size_t r = 0; r < rows && real < columns; ++r)
    std::fill(distances + r * columns + real, distances + (r + 1) * columns, kNoDistance);
}

const DistanceKernels& distance_kernels(Norm norm) {
  return norm == Norm::hamming ? hamming_kernels() : l2_kernels();
}

float match_distance(Norm norm, std::int32_t measured) {
  const auto distance = static_cast<float>(measured);
  return norm == Norm::l2 ? std::sqrt(distance) : distance;
}

void require_comparable(const Descriptors& a, const Descriptors& b) {
  constexpr std::size_t kMaxL2Bytes = 32768;  // so that squares fit 31 bits
  require(a.norm() == b.norm() && a.bytes() == b.bytes(), "both sides have descriptors of one kind");
  require(a.norm() == Norm::hamming || a.bytes() <= kMaxL2Bytes, "L2 descriptors have at most 32 KiB");
}

}  // namespace cairn
