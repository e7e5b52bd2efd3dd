// SPDX-License-Identifier: Apache-2.0
#include "cairn/matching/matching_candidates.h"

#include <algorithm>

#include "cairn/matching/packed_descriptors.h"

namespace cairn {
namespace {

/// A distance and an index as one number: of equal distances the one with the lower index is less.
using Key = std::uint64_t;
constexpr Key kNone = ~Key{0};

Key key_of(std::int32_t distance, std::size_t index) {
  return static_cast<Key>(distance) << 32 | index;
}
std::int32_t distance_of(Key key) {
  return static_cast<std::int32_t>(key >> 32);
}
std::int32_t index_of(Key key) {
  return static_cast<std::int32_t>(key & 0xFFFFFFFFU);
}

struct TwoNearest {
  Key first = kNone, second = kNone;

  /// Without a branch, which could not be predicted.
  void see(Key key) {
    second = std::min(second, std::max(first, key));
    first = std::min(first, key);
  }
};

/// Writes the nearest of queries [begin, end), and returns of each train the nearest of those queries.
std::vector<Key> search_block(std::size_t begin, std::size_t end, std::size_t trains,
                              const FindCandidates& find, std::vector<TwoNearest>& of_query) {
  std::vector<Key> of_train(trains, kNone);
  Candidates candidates;
  for (std::size_t q = begin; q < end; ++q) {
    candidates.clear();
    find(q, candidates);
    TwoNearest nearest;
    for (std::size_t i = 0; i < candidates.trains.size(); ++i) {
      const auto train = static_cast<std::size_t>(candidates.trains[i]);
      nearest.see(key_of(candidates.distances[i], train));
      of_train[train] = std::min(of_train[train], key_of(candidates.distances[i], q));
    }
    of_query[q] = nearest;
  }
  return of_train;
}

void merge(std::vector<Key>& nearest, const std::vector<Key>& others) {
  for (std::size_t i = 0; i < nearest.size(); ++i) nearest[i] = std::min(nearest[i], others[i]);
}

bool is_believed(Norm norm, const TwoNearest& nearest, const MatchOptions& options) {
  const auto first = static_cast<double>(match_distance(norm, distance_of(nearest.first)));
  const bool unrivalled =
      options.max_ratio == 0 || nearest.second == kNone ||
      first < options.max_ratio * static_cast<double>(match_distance(norm, distance_of(nearest.second)));
  return unrivalled && first <= options.max_distance;
}

}  // namespace

void Candidates::measure(const Descriptors& queries, std::size_t query, const Descriptors& descriptors) {
  distances.resize(trains.size());
  if (trains.empty()) return;
  DistanceList list;
  list.query = queries.row(query);
  list.rows = descriptors.row(0);
  list.words64 = descriptors.stride() / 8;
  list.indices = trains.data();
  list.count = trains.size();
  list.distances = distances.data();
  distance_kernels(descriptors.norm()).to_rows(list);
}

std::vector<std::optional<Match>> match_candidates(std::size_t queries, std::size_t trains, Norm norm,
                                                   const FindCandidates& find, const MatchOptions& options,
                                                   const Executor& executor) {
  constexpr std::size_t kFewest = 128, kMostBlocks = 64;  // memory for the trains of each block stays small
  const std::size_t grain = std::max(kFewest, queries / kMostBlocks + 1);
  const std::size_t blocks = (queries + grain - 1) / grain;
  std::vector<TwoNearest> of_query(queries);
  auto of_train = executor.map<std::vector<Key>>(blocks, [&](std::size_t block) {
    return search_block(block * grain, std::min(queries, (block + 1) * grain), trains, find, of_query);
  });
  for (std::size_t block = 1; block < blocks; ++block) merge(of_train[0], of_train[block]);
  std::vector<std::optional<Match>> matches(queries);
  for (std::size_t q = 0; q < queries; ++q) {
    const TwoNearest& nearest = of_query[q];
    if (nearest.first == kNone || !is_believed(norm, nearest, options)) continue;
    const Match match{static_cast<std::int32_t>(q), index_of(nearest.first),
                      match_distance(norm, distance_of(nearest.first))};
    const Key of_match = of_train[0][static_cast<std::size_t>(match.train)];
    if (!options.mutual || index_of(of_match) == match.query) matches[q] = match;
  }
  return matches;
}

std::vector<Match> without_gaps(const std::vector<std::optional<Match>>& matches) {
  std::vector<Match> result;
  for (const auto& match : matches)
    if (match) result.push_back(*match);
  return result;
}

}  // namespace cairn
