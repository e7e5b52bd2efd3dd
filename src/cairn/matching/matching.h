// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "cairn/core/executor.h"
#include "cairn/features/features.h"

namespace cairn {

/// Pairs descriptor `query` of one image with the similar descriptor `train` of another.
struct Match {
  std::int32_t query = 0;
  std::int32_t train = 0;
  float distance = 0;  ///< bits for Hamming, Euclidean distance for L2
  bool operator==(const Match&) const = default;
};

/// Sets which nearest neighbours are accepted. The defaults accept all.
struct MatchOptions {
  /// Maximum distance, inclusive: bits or Euclidean distance.
  double max_distance = std::numeric_limits<double>::infinity();
  /// Maximum ratio, exclusive, of the nearest distance to the second nearest (Lowe 2004, sec. 7.1: 0.8); 0
  /// turns the test off. A single train has no rival and passes; two equal ones never do.
  double max_ratio = 0;
  /// If true, the query must also be the train's nearest.
  bool mutual = false;

  /// Throws PreconditionError if a number is negative or NaN.
  void validate() const;
};

/// Returns the distance up to which two descriptors may show the same thing: under one in a thousand random
/// pairs are nearer.
[[nodiscard]] double descriptor_limit(const Descriptors& descriptors);

// Brute force over all pairs, O(queries * trains). Distances are exact integers (before the root of L2), and
// of equal ones the lower index is nearer; so results are the same on every processor and at any number of
// threads. All throw PreconditionError if the two kinds of descriptor differ; an empty side gives no match.

/// Returns the matches that `options` accept, ordered by query, at most one for each.
[[nodiscard]] std::vector<Match> match_descriptors(const Descriptors& query, const Descriptors& train,
                                                   const MatchOptions& options,
                                                   const Executor& executor = Executor());

/// Returns the two nearest trains of every query, in order. If there is only one train, the second has train
/// -1 and an infinite distance.
[[nodiscard]] std::vector<std::array<Match, 2>> match_two_nearest(const Descriptors& query,
                                                                  const Descriptors& train,
                                                                  const Executor& executor = Executor());

/// Returns the mutual nearest neighbours without a limit, ordered by query.
[[nodiscard]] std::vector<Match> match_mutual(const Descriptors& query, const Descriptors& train,
                                              const Executor& executor = Executor());

/// Keeps the matches with distance <= factor * max(smallest distance, floor): good matches of a pair are not
/// much worse than its best. The floor prevents a perfect match (distance 0) from rejecting all others.
[[nodiscard]] std::vector<Match> filter_by_distance(const std::vector<Match>& matches, double factor,
                                                    double floor);

}  // namespace cairn
