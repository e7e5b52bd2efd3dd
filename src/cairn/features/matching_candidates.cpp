// SPDX-License-Identifier: Apache-2.0
#include "cairn/features/matching_candidates.h"

#include <algorithm>

#include "cairn/features/packed_descriptors.h"

namespace cairn {
namespace {

using NearestOf = std::vector<NearestCandidate>;

/// Writes the nearest of queries [begin, end), and returns of each train the nearest of those queries.
NearestOf search_block(std::size_t begin, std::size_t end, std::size_t trains, const FindCandidates& find,
                       NearestOf& of_query) {
  NearestOf of_train(trains);
  Candidates candidates;
  for (std::size_t q = begin; q < end; ++q) {
    candidates.clear();
    find(q, candidates);
    for (std::size_t i = 0; i < candidates.trains.size(); ++i) {
      const std::int32_t train = candidates.trains[i], distance = candidates.distances[i];
      of_query[q].see(distance, train);
      of_train[static_cast<std::size_t>(train)].see(distance, static_cast<std::int32_t>(q));
    }
  }
  return of_train;
}

void merge(NearestOf& nearest, const NearestOf& others) {
  for (std::size_t i = 0; i < nearest.size(); ++i)
    if (others[i].index >= 0) nearest[i].see(others[i].distance, others[i].index);
}

bool is_believed(Norm norm, const NearestCandidate& nearest, const MatchOptions& options) {
  const auto first = static_cast<double>(match_distance(norm, nearest.distance));
  const bool unrivalled =
      options.max_ratio == 0 || nearest.second_distance == kNoDistance ||
      first < options.max_ratio * static_cast<double>(match_distance(norm, nearest.second_distance));
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
  NearestOf of_query(queries);
  auto of_train = executor.map<NearestOf>(blocks, [&](std::size_t block) {
    return search_block(block * grain, std::min(queries, (block + 1) * grain), trains, find, of_query);
  });
  for (std::size_t block = 1; block < blocks; ++block) merge(of_train[0], of_train[block]);
  std::vector<std::optional<Match>> matches(queries);
  for (std::size_t q = 0; q < queries; ++q) {
    const NearestCandidate& nearest = of_query[q];
    const auto query = static_cast<std::int32_t>(q);
    if (nearest.index < 0 || !is_believed(norm, nearest, options)) continue;
    if (options.mutual && of_train[0][static_cast<std::size_t>(nearest.index)].index != query) continue;
    matches[q] = Match{query, nearest.index, match_distance(norm, nearest.distance)};
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
