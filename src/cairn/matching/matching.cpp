// SPDX-License-Identifier: Apache-2.0
#include "cairn/matching/matching.h"

#include <algorithm>
#include <iterator>

#include "cairn/matching/kernels/nearest_kernels.h"
#include "cairn/matching/packed_descriptors.h"

namespace cairn {
namespace {

constexpr std::size_t kTileRows = 4;       // as many queries as the kernels work on at once
constexpr std::size_t kTileBytes = 65536;  // of packed trains, which stay in a near cache for a block
constexpr std::size_t kMaxTileGroups = 64;

/// Nearest train of each query and, where asked for, nearest query of each train.
struct Nearest {
  std::vector<TwoSmallest> of_query;
  std::vector<std::int32_t> query_of_train;  // -1 never occurs where there is a query
};

struct Wanted {
  bool second = false;  // nearest of each query
  bool mutual = false;
};

/// Smallest distances of trains, padded to whole groups.
struct Columns {
  explicit Columns(std::size_t count) : distances(count, kNoDistance), rows(count, -1) {}
  std::vector<std::int32_t> distances, rows;

  [[nodiscard]] ColumnMinima from(std::size_t column) {
    return {distances.data() + column, rows.data() + column};
  }
  /// Those of later rows: they win where they are strictly nearer.
  void merge(const Columns& later) {
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (later.distances[i] < distances[i]) distances[i] = later.distances[i], rows[i] = later.rows[i];
  }
};

/// Joins what a tile of higher places holds.
void join(TwoSmallest& so_far, TwoSmallest tile, std::size_t first_place) {
  const auto offset = static_cast<std::int32_t>(first_place);
  if (tile.first_at >= 0) tile.first_at += offset;
  if (tile.second_at >= 0) tile.second_at += offset;
  if (tile.first < so_far.first) {
    if (so_far.first <= tile.second) tile.second = so_far.first, tile.second_at = so_far.first_at;
    so_far = tile;
  } else if (tile.first < so_far.second) {
    so_far.second = tile.first, so_far.second_at = tile.first_at;
  }
}

/// All pairs in tiles of a few queries and as many trains as the cache holds.
class Search {
 public:
  Search(const Descriptors& query, const Descriptors& train, Wanted wanted)
      : query_(query), train_(train), wanted_(wanted), kernels_(nearest_kernels()) {
    const std::size_t groups = kTileBytes / std::max<std::size_t>(1, train_.bytes_per_group());
    tile_groups_ = std::clamp<std::size_t>(groups, 1, kMaxTileGroups);
  }

  [[nodiscard]] Nearest run(const Executor& executor) const {
    Nearest nearest;
    nearest.of_query.resize(query_.count());
    const std::size_t grain = rows_per_block(), blocks = (query_.count() + grain - 1) / grain;
    std::vector<Columns> columns(wanted_.mutual ? blocks : 0, Columns(0));
    executor.for_each(blocks, [&](std::size_t block) {
      const std::size_t begin = block * grain, end = std::min(query_.count(), begin + grain);
      Columns minima(columns.empty() ? 0 : train_.groups() * kPackedLanes);
      search_block(begin, end, nearest.of_query, minima);
      if (!columns.empty()) columns[block] = std::move(minima);
    });
    for (std::size_t block = 1; block < columns.size(); ++block) columns[0].merge(columns[block]);
    if (!columns.empty()) nearest.query_of_train = std::move(columns[0].rows);
    return nearest;
  }

 private:
  /// Does not depend on the number of threads; few enough blocks that their columns take little memory.
  [[nodiscard]] std::size_t rows_per_block() const {
    constexpr std::size_t kFewest = 128, kMostBlocks = 64;
    return std::max(kFewest, (query_.count() / kMostBlocks + kTileRows) / kTileRows * kTileRows);
  }

  void search_block(std::size_t begin, std::size_t end, std::vector<TwoSmallest>& of_query,
                    Columns& minima) const {
    std::vector<std::int32_t> distances(kTileRows * tile_groups_ * kPackedLanes);
    for (std::size_t group = 0; group < train_.groups(); group += tile_groups_) {
      const std::size_t groups = std::min(tile_groups_, train_.groups() - group);
      for (std::size_t row = begin; row < end; row += kTileRows) {
        const std::size_t rows = std::min(kTileRows, end - row);
        train_.measure(query_, row, rows, group, groups, distances.data());
        see_rows(distances.data(), row, rows, group, groups, of_query);
        if (wanted_.mutual)
          kernels_.update_columns(distances.data(), rows, groups * kPackedLanes,
                                  static_cast<std::int32_t>(row), minima.from(group * kPackedLanes));
      }
    }
  }

  void see_rows(const std::int32_t* distances, std::size_t row, std::size_t rows, std::size_t group,
                std::size_t groups, std::vector<TwoSmallest>& of_query) const {
    const std::size_t columns = groups * kPackedLanes;
    const auto smallest = wanted_.second ? kernels_.two_smallest : kernels_.smallest;
    for (std::size_t r = 0; r < rows; ++r)
      join(of_query[row + r], smallest(distances + r * columns, columns), group * kPackedLanes);
  }

  const Descriptors& query_;
  PackedDescriptors train_;
  Wanted wanted_;
  const NearestKernels& kernels_;
  std::size_t tile_groups_ = 1;
};

Match to_match(Norm norm, std::size_t query, std::int32_t train, std::int32_t measured) {
  const float distance = train < 0 ? std::numeric_limits<float>::infinity() : match_distance(norm, measured);
  return {static_cast<std::int32_t>(query), train, distance};
}

bool is_believed(const Match& first, const Match& second, const MatchOptions& options) {
  const bool unrivalled =
      options.max_ratio == 0 ||
      static_cast<double>(first.distance) < options.max_ratio * static_cast<double>(second.distance);
  return unrivalled && static_cast<double>(first.distance) <= options.max_distance;
}

Nearest search(const Descriptors& query, const Descriptors& train, const Wanted& wanted,
               const Executor& executor) {
  if (query.count() == 0 || train.count() == 0) return {};
  require_comparable(query, train);
  return Search(query, train, wanted).run(executor);
}

}  // namespace

double descriptor_limit(const Descriptors& descriptors) {
  constexpr double kBitShare = 0.3;
  constexpr double kByteDistance = 300;  // of SIFT's vectors, which have the length 512
  return descriptors.norm() == Norm::hamming ? kBitShare * 8.0 * static_cast<double>(descriptors.bytes())
                                             : kByteDistance;
}

void MatchOptions::validate() const {
  require(max_distance >= 0, "the distance limit is not negative");
  require(max_ratio >= 0, "the ratio is not negative");
}

std::vector<Match> match_descriptors(const Descriptors& query, const Descriptors& train,
                                     const MatchOptions& options, const Executor& executor) {
  options.validate();
  const Nearest nearest = search(query, train, {options.max_ratio > 0, options.mutual}, executor);
  std::vector<Match> matches;
  for (std::size_t q = 0; q < nearest.of_query.size(); ++q) {
    const TwoSmallest& found = nearest.of_query[q];
    const auto t = static_cast<std::size_t>(found.first_at);
    if (options.mutual && nearest.query_of_train[t] != static_cast<std::int32_t>(q)) continue;
    const Match first = to_match(query.norm(), q, found.first_at, found.first);
    const Match second = to_match(query.norm(), q, found.second_at, found.second);
    if (is_believed(first, second, options)) matches.push_back(first);
  }
  return matches;
}

std::vector<std::array<Match, 2>> match_two_nearest(const Descriptors& query, const Descriptors& train,
                                                    const Executor& executor) {
  const Nearest nearest = search(query, train, {true, false}, executor);
  std::vector<std::array<Match, 2>> matches;
  matches.reserve(nearest.of_query.size());
  for (std::size_t q = 0; q < nearest.of_query.size(); ++q) {
    const TwoSmallest& found = nearest.of_query[q];
    matches.push_back({to_match(query.norm(), q, found.first_at, found.first),
                       to_match(query.norm(), q, found.second_at, found.second)});
  }
  return matches;
}

std::vector<Match> match_mutual(const Descriptors& query, const Descriptors& train,
                                const Executor& executor) {
  MatchOptions options;
  options.mutual = true;
  return match_descriptors(query, train, options, executor);
}

std::vector<Match> filter_by_distance(const std::vector<Match>& matches, double factor, double floor) {
  if (matches.empty()) return {};
  const auto closest = std::min_element(
      matches.begin(), matches.end(), [](const Match& a, const Match& b) { return a.distance < b.distance; });
  const double limit = factor * std::max(static_cast<double>(closest->distance), floor);
  std::vector<Match> kept;
  std::copy_if(matches.begin(), matches.end(), std::back_inserter(kept),
               [&](const Match& m) { return m.distance <= limit; });
  return kept;
}

}  // namespace cairn
