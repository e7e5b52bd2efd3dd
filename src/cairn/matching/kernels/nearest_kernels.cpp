// SPDX-License-Identifier: Apache-2.0
#include "cairn/matching/kernels/nearest_kernels.h"

namespace cairn::CAIRN_ISA {
namespace {

#if defined(__AVX512F__)
constexpr std::size_t kLanes = 16;
#elif defined(__AVX2__)
constexpr std::size_t kLanes = 8;
#else
constexpr std::size_t kLanes = 4;
#endif

/// The compilers' own vectors: operators and ?: work on each lane.
using Lanes = std::int32_t __attribute__((vector_size(4 * kLanes)));

[[gnu::always_inline]] inline Lanes load(const std::int32_t* from) {
  Lanes lanes;
  __builtin_memcpy(&lanes, from, sizeof lanes);
  return lanes;
}
[[gnu::always_inline]] inline void store(std::int32_t* to, const Lanes& lanes) {
  __builtin_memcpy(to, &lanes, sizeof lanes);
}
[[gnu::always_inline]] inline Lanes all(std::int32_t value) {
  return Lanes{} + value;
}
[[gnu::always_inline]] inline Lanes min(const Lanes& a, const Lanes& b) {
  return a < b ? a : b;
}
[[gnu::always_inline]] inline Lanes max(const Lanes& a, const Lanes& b) {
  return a > b ? a : b;
}
[[gnu::always_inline]] inline Lanes places() {
  Lanes lanes{};
  for (std::size_t i = 0; i < kLanes; ++i) lanes[i] = static_cast<std::int32_t>(i);
  return lanes;
}

/// A distance and its place as one number, in the order that we look for.
inline std::uint64_t key_of(std::int32_t distance, std::int32_t at) {
  return static_cast<std::uint64_t>(static_cast<std::uint32_t>(distance)) << 32 |
         static_cast<std::uint32_t>(at);
}
inline std::int32_t distance_of(std::uint64_t key) {
  return static_cast<std::int32_t>(key >> 32);
}
inline std::int32_t place_of(std::uint64_t key) {
  return static_cast<std::int32_t>(key & 0xFFFFFFFFU);
}

/// The two smallest keys, without branches: which lane wins cannot be predicted.
struct TwoKeys {
  std::uint64_t first = key_of(kNoDistance, -1), second = first;
};
[[gnu::always_inline]] inline void insert(TwoKeys& two, std::uint64_t key) {
  const std::uint64_t larger = key < two.first ? two.first : key;
  two.first = key < two.first ? key : two.first;
  two.second = larger < two.second ? larger : two.second;
}

/// Each lane has seen its places in ascending order, so that what it holds is its lowest place.
TwoSmallest smallest(const std::int32_t* distances, std::size_t count) {
  Lanes best = all(kNoDistance), best_at = all(-1), at = places();
  for (std::size_t i = 0; i < count; i += kLanes) {
    const Lanes here = load(distances + i);
    best_at = here < best ? at : best_at;
    best = min(here, best);
    at += static_cast<std::int32_t>(kLanes);
  }
  std::uint64_t nearest = key_of(kNoDistance, -1);
  for (std::size_t i = 0; i < kLanes; ++i) {
    const std::uint64_t key = key_of(best[i], best_at[i]);
    nearest = key < nearest ? key : nearest;
  }
  TwoSmallest result;
  result.first = distance_of(nearest), result.first_at = place_of(nearest);
  return result;
}

TwoSmallest two_smallest(const std::int32_t* distances, std::size_t count) {
  Lanes first = all(kNoDistance), first_at = all(-1), second = first, second_at = first_at, at = places();
  for (std::size_t i = 0; i < count; i += kLanes) {
    const Lanes here = load(distances + i);
    second_at = here < second ? at : second_at;
    second_at = here < first ? first_at : second_at;
    first_at = here < first ? at : first_at;
    second = min(second, max(here, first));
    first = min(here, first);
    at += static_cast<std::int32_t>(kLanes);
  }
  TwoKeys nearest;
  for (std::size_t i = 0; i < kLanes; ++i) insert(nearest, key_of(first[i], first_at[i]));
  for (std::size_t i = 0; i < kLanes; ++i) insert(nearest, key_of(second[i], second_at[i]));
  return {distance_of(nearest.first), place_of(nearest.first), distance_of(nearest.second),
          place_of(nearest.second)};
}

void update_columns(const std::int32_t* distances, std::size_t rows, std::size_t count,
                    std::int32_t first_row, const ColumnMinima& minima) {
  for (std::size_t i = 0; i < count; i += kLanes) {
    Lanes best = load(minima.distances + i), best_row = load(minima.rows + i);
    for (std::size_t r = 0; r < rows; ++r) {
      const Lanes here = load(distances + r * count + i);
      best_row = here < best ? all(first_row + static_cast<std::int32_t>(r)) : best_row;
      best = min(here, best);
    }
    store(minima.distances + i, best);
    store(minima.rows + i, best_row);
  }
}

}  // namespace

extern const NearestKernels kNearestKernels;
const NearestKernels kNearestKernels{smallest, two_smallest, update_columns};

}  // namespace cairn::CAIRN_ISA
