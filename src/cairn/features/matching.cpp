// SPDX-License-Identifier: Apache-2.0
#include "cairn/features/matching.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace cairn {
namespace {

/// Nearest neighbours in both directions from one pass over all pairs.
class MutualNearest {
 public:
  MutualNearest(std::size_t queries, std::size_t trains)
      : train_of_query_(queries), query_of_train_(trains) {}

  void see(std::size_t query, std::size_t train, std::uint32_t distance) {
    update(train_of_query_[query], train, distance);
    update(query_of_train_[train], query, distance);
  }

  [[nodiscard]] std::vector<Match> matches(Norm norm) const {
    std::vector<Match> result;
    for (std::size_t q = 0; q < train_of_query_.size(); ++q) {
      const Nearest& train = train_of_query_[q];
      if (train.index == kNone || query_of_train_[train.index].index != q) continue;
      const auto distance = static_cast<float>(train.distance);
      result.push_back({static_cast<std::int32_t>(q), static_cast<std::int32_t>(train.index),
                        norm == Norm::l2 ? std::sqrt(distance) : distance});
    }
    return result;
  }

 private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  struct Nearest {
    std::uint32_t index = kNone;
    std::uint32_t distance = kNone;
  };
  static void update(Nearest& nearest, std::size_t index, std::uint32_t distance) {
    if (distance < nearest.distance) nearest = {static_cast<std::uint32_t>(index), distance};
  }

  std::vector<Nearest> train_of_query_, query_of_train_;
};

/// Bits that differ in `words` 64-bit words; without the instruction, std::popcount counts by shifts and
/// masks.
inline std::uint32_t hamming(const std::uint64_t* a, const std::uint64_t* b, std::size_t words) {
  int bits = 0;
  for (std::size_t w = 0; w < words; ++w) bits += std::popcount(a[w] ^ b[w]);
  return static_cast<std::uint32_t>(bits);
}

template <std::size_t kFixedWords>
[[gnu::always_inline]] inline void see_all_hamming(const Descriptors& query, const Descriptors& train,
                                                   MutualNearest& nearest) {
  const std::size_t words = kFixedWords > 0 ? kFixedWords : query.stride() / 8;
  for (std::size_t q = 0; q < query.count(); ++q) {
    const std::uint64_t* a = query.words() + q * words;
    for (std::size_t t = 0; t < train.count(); ++t)
      nearest.see(q, t, hamming(a, train.words() + t * words, words));
  }
}

void match_hamming_plain(const Descriptors& query, const Descriptors& train, MutualNearest& nearest) {
  see_all_hamming<0>(query, train, nearest);
}

#ifdef __x86_64__
[[gnu::target("popcnt")]] void match_hamming_popcnt(const Descriptors& query, const Descriptors& train,
                                                    MutualNearest& nearest) {
  constexpr std::size_t kOrbWords = 4;
  query.stride() == 8 * kOrbWords ? see_all_hamming<kOrbWords>(query, train, nearest)
                                  : see_all_hamming<0>(query, train, nearest);
}
#endif

void match_hamming(const Descriptors& query, const Descriptors& train, MutualNearest& nearest) {
#ifdef __x86_64__
  if (__builtin_cpu_supports("popcnt")) return match_hamming_popcnt(query, train, nearest);
#endif
  match_hamming_plain(query, train, nearest);
}

void match_l2(const Descriptors& query, const Descriptors& train, MutualNearest& nearest) {
  for (std::size_t q = 0; q < query.count(); ++q) {
    const std::uint8_t* a = query.row(q);
    for (std::size_t t = 0; t < train.count(); ++t) {
      const std::uint8_t* b = train.row(t);
      std::int32_t squared = 0;
      for (std::size_t i = 0; i < query.stride(); ++i) squared += (a[i] - b[i]) * (a[i] - b[i]);
      nearest.see(q, t, static_cast<std::uint32_t>(squared));
    }
  }
}

}  // namespace

std::vector<Match> match_mutual(const Descriptors& query, const Descriptors& train) {
  if (query.count() == 0 || train.count() == 0) return {};
  require(query.norm() == train.norm() && query.bytes() == train.bytes(),
          "both sides have descriptors of one kind");
  MutualNearest nearest(query.count(), train.count());
  query.norm() == Norm::hamming ? match_hamming(query, train, nearest) : match_l2(query, train, nearest);
  return nearest.matches(query.norm());
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
