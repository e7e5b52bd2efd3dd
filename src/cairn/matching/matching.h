// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "cairn/core/executor.h"
#include "cairn/features/features.h"

namespace cairn {

/// Descriptor `query` of one image looks like descriptor `train` of another.
struct Match {
  std::int32_t query = 0;
  std::int32_t train = 0;
  float distance = 0;  ///< bits for Hamming, Euclidean distance for L2
  bool operator==(const Match&) const = default;
};

/// Which nearest neighbours are believed. The defaults believe all.
struct MatchOptions {
  /// Bits or Euclidean distance, inclusive.
  double max_distance = std::numeric_limits<double>::infinity();
  /// Nearest below this share of the second nearest's distance (Lowe 2004, sec. 7.1: 0.8); 0 turns the test
  /// off. A single train has no rival and passes; two equal ones never do.
  double max_ratio = 0;
  /// The query is also the train's nearest.
  bool mutual = false;

  /// PreconditionError for a negative number or NaN.
  void validate() const;
};

/// How far a descriptor may change between two views of one thing: of random pairs under one in a thousand
/// are nearer.
[[nodiscard]] double descriptor_limit(const Descriptors& descriptors);

// Brute force over all pairs, O(queries * trains). Distances are exact integers (before the root of L2), and
// of equal ones the lower index is nearer; so results are the same on every processor and at any number of
// threads. All throw PreconditionError where the two kinds of descriptor differ; an empty side gives nothing.

/// The matches that `options` believe, ordered by query, at most one for each.
[[nodiscard]] std::vector<Match> match_descriptors(const Descriptors& query, const Descriptors& train,
                                                   const MatchOptions& options,
                                                   const Executor& executor = Executor());

/// The two nearest of every query, in order; where there is one train only, the second has train -1 and an
/// infinite distance.
[[nodiscard]] std::vector<std::array<Match, 2>> match_two_nearest(const Descriptors& query,
                                                                  const Descriptors& train,
                                                                  const Executor& executor = Executor());

/// Mutual nearest neighbours without a limit, ordered by query.
[[nodiscard]] std::vector<Match> match_mutual(const Descriptors& query, const Descriptors& train,
                                              const Executor& executor = Executor());

/// Keeps matches with distance <= factor * max(smallest distance, floor): good matches of a pair are not much
/// worse than its best. The floor keeps a perfect match (distance 0) from throwing all others out.
[[nodiscard]] std::vector<Match> filter_by_distance(const std::vector<Match>& matches, double factor,
                                                    double floor);

}  // namespace cairn
