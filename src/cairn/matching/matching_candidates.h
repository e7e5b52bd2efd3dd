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

/// The trains that one query may match, in any order, with their distances as the kernels measure them.
struct Candidates {
  std::vector<std::int32_t> trains, distances;

  std::vector<std::uint32_t> flags;  ///< room to work in: 1 for what is a candidate, else 0
  std::vector<std::int32_t> tile;    ///< room to work in

  void clear() {
    trains.clear();
    distances.clear();
  }
  /// Distances from row `query` of `queries` to the rows `trains` of `descriptors`.
  void measure(const Descriptors& queries, std::size_t query, const Descriptors& descriptors);
};

/// Fills the candidates of a query; they are empty before. Called from several threads.
using FindCandidates = std::function<void(std::size_t query, Candidates& candidates)>;

/// For each query the match that `options` believe among its candidates, or nothing. The ratio's second is
/// the query's second candidate; mutual means that no other query with the same candidate is nearer. The same
/// bits at any number of threads. `queries` and `trains`: how many there are.
[[nodiscard]] std::vector<std::optional<Match>> match_candidates(std::size_t queries, std::size_t trains,
                                                                 Norm norm, const FindCandidates& find,
                                                                 const MatchOptions& options,
                                                                 const Executor& executor);

/// Those that are there, in their order.
[[nodiscard]] std::vector<Match> without_gaps(const std::vector<std::optional<Match>>& matches);

}  // namespace cairn
