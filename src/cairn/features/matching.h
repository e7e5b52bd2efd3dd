// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "cairn/features/features.h"

namespace cairn {

/// Descriptor `query` of one image looks like descriptor `train` of another.
struct Match {
  std::int32_t query = 0;
  std::int32_t train = 0;
  float distance = 0;  ///< bits for Hamming, Euclidean distance for L2
};

/// Mutual nearest neighbours by brute force, ordered by query: each is the other's nearest, ties going to the
/// lower index. Throws PreconditionError where the two kinds of descriptor differ. O(queries * trains).
[[nodiscard]] std::vector<Match> match_mutual(const Descriptors& query, const Descriptors& train);

/// Keeps matches with distance <= factor * max(smallest distance, floor): good matches of a pair are not much
/// worse than its best. The floor keeps a perfect match (distance 0) from throwing all others out.
[[nodiscard]] std::vector<Match> filter_by_distance(const std::vector<Match>& matches, double factor,
                                                    double floor);

}  // namespace cairn
