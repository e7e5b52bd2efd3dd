// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "cairn/core/executor.h"
#include "cairn/features/features.h"
#include "cairn/matching/matching.h"

namespace cairn {

/// Holds the trains that one query may match, in any order, with their distances as the kernels measure them.
struct Candidates {
  std::vector<std::int32_t> trains, distances;

  std::vector<std::uint32_t> flags;  ///< scratch memory: 1 for a candidate, else 0
  std::vector<std::int32_t> tile;    ///< scratch memory for distances

  void clear() {
    trains.clear();
    distances.clear();
  }
  /// Computes the distances from row `query` of `queries` to the rows `trains` of `descriptors`.
  void measure(const Descriptors& queries, std::size_t query, const Descriptors& descriptors);
};

/// Fills the candidates of a query, which are empty before. Called from several threads.
using FindCandidates = std::function<void(std::size_t query, Candidates& candidates)>;

/// Returns for each query the match that `options` accept among its candidates, or nullopt. The ratio test
/// takes the query's second candidate; mutual means that no other query with the same candidate is nearer.
/// `queries` and `trains` are their numbers. Gives the same bits at any number of threads.
[[nodiscard]] std::vector<std::optional<Match>> match_candidates(std::size_t queries, std::size_t trains,
                                                                 Norm norm, const FindCandidates& find,
                                                                 const MatchOptions& options,
                                                                 const Executor& executor);

/// Returns the matches that have a value, in their order.
[[nodiscard]] std::vector<Match> without_gaps(const std::vector<std::optional<Match>>& matches);

}  // namespace cairn
