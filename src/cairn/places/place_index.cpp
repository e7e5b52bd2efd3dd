// SPDX-License-Identifier: Apache-2.0
#include "cairn/places/place_index.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "cairn/core/error.h"
#include "cairn/matching/kernels/nearest_kernels.h"
#include "cairn/matching/matching_candidates.h"
#include "cairn/matching/packed_descriptors.h"

namespace cairn {
namespace {

using Slot = std::int32_t;

/// Says that descriptor `query` of the query matches something of keyframe `slot`.
struct Vote {
  std::int32_t query;
  Slot slot;
};

using Visit = DescriptorTree::Visit;

/// Lets every row of a leaf vote for the nearest of the queries that visit it.
class LeafVoting {
 public:
  LeafVoting(const DescriptorTree& tree, const Descriptors& descriptors, const std::vector<char>& admitted,
             std::int32_t max_measured)
      : tree_(tree), descriptors_(descriptors), admitted_(admitted), max_measured_(max_measured) {}

  /// Collects the votes in one leaf; `visits` are all those of that leaf.
  void vote(std::span<const Visit> visits, std::vector<Vote>& votes) {
    const DescriptorTree::Leaf& leaf = tree_.leaf(visits.front().leaf);
    nearest_.assign(leaf.owners.size(), {kNoDistance, -1});
    for (const Visit& visit : visits) {
      tree_.measure(descriptors_, static_cast<std::size_t>(visit.query), leaf, distances_);
      for (std::size_t i = 0; i < distances_.size(); ++i)
        if (distances_[i] < nearest_[i].first) nearest_[i] = {distances_[i], visit.query};
    }
    for (std::size_t i = 0; i < nearest_.size(); ++i)
      if (nearest_[i].first <= max_measured_ && admitted_[static_cast<std::size_t>(leaf.owners[i])] != 0)
        votes.push_back({nearest_[i].second, leaf.owners[i]});
  }

 private:
  const DescriptorTree& tree_;
  const Descriptors& descriptors_;
  const std::vector<char>& admitted_;
  std::int32_t max_measured_;
  std::vector<std::int32_t> distances_;
  std::vector<std::pair<std::int32_t, std::int32_t>> nearest_;  // distance and query of each row
};

std::vector<Vote> collect_votes(const DescriptorTree& tree, const Descriptors& descriptors,
                                std::size_t leaves_per_descriptor, const std::vector<char>& admitted,
                                std::int32_t max_measured) {
  const std::vector<Visit> visits = tree.find_leaves(descriptors, leaves_per_descriptor);
  LeafVoting voting(tree, descriptors, admitted, max_measured);
  std::vector<Vote> votes;
  for (std::size_t begin = 0, end = 0; begin < visits.size(); begin = end) {
    while (end < visits.size() && visits[end].leaf == visits[begin].leaf) ++end;
    tree.fetch_ahead(visits, begin);
    voting.vote(std::span(visits).subspan(begin, end - begin), votes);
  }
  return votes;
}

/// Returns the slots that each descriptor of the query votes for, each once.
std::vector<std::vector<Slot>> slots_by_query(const std::vector<Vote>& votes, std::size_t queries) {
  std::vector<std::vector<Slot>> slots(queries);
  for (const Vote& vote : votes) slots[static_cast<std::size_t>(vote.query)].push_back(vote.slot);
  for (std::vector<Slot>& of_query : slots) {
    std::sort(of_query.begin(), of_query.end());
    of_query.erase(std::unique(of_query.begin(), of_query.end()), of_query.end());
  }
  return slots;
}

/// Returns the scores of `slots` slots, of which `documents` are admitted.
std::vector<double> score(const std::vector<std::vector<Slot>>& voted_for, std::size_t slots,
                          std::size_t documents) {
  std::vector<double> scores(slots, 0.0);
  double total = 0;
  for (const std::vector<Slot>& found : voted_for) {
    const auto frequency = static_cast<double>(std::max<std::size_t>(1, found.size()));
    const double weight = std::log(static_cast<double>(documents + 1) / frequency);
    total += weight;
    for (const Slot slot : found) scores[static_cast<std::size_t>(slot)] += weight;
  }
  for (double& of_slot : scores) of_slot /= total;
  return scores;
}

void keep_best(std::vector<PlaceCandidate>& candidates, std::size_t most) {
  const auto better = [](const PlaceCandidate& a, const PlaceCandidate& b) {
    return a.score != b.score ? a.score > b.score : a.id < b.id;
  };
  const auto kept = static_cast<std::ptrdiff_t>(std::min(most, candidates.size()));
  std::partial_sort(candidates.begin(), candidates.begin() + kept, candidates.end(), better);
  candidates.resize(static_cast<std::size_t>(kept));
}

}  // namespace

void PlaceIndexOptions::validate() const {
  require(max_distance_share >= 0 && std::isfinite(max_distance_share),
          "the limit of distances is not negative");
  require(leaves_per_descriptor >= 1, "each descriptor looks into a leaf");
  tree.validate();
}

PlaceIndex::PlaceIndex(const PlaceIndexOptions& options) : options_(options) {
  options.validate();
}

void PlaceIndex::take_kind(const Descriptors& descriptors) {
  if (!tree_) kind_ = Descriptors(descriptors.norm(), descriptors.bytes(), 0);
  require_comparable(descriptors, kind_);
  if (!tree_) tree_.emplace(kind_, options_.tree);
}

/// Measures distances of descriptors of one image, which show different points. Some pairs are enough; they
/// lie far apart in the list, as neighbours in it may be neighbours in the image.
void PlaceIndex::measure_unrelated(const Descriptors& descriptors) {
  constexpr std::size_t kPairs = 64;
  const std::size_t half = descriptors.count() / 2, pairs = std::min(half, kPairs);
  Candidates pair;
  for (std::size_t i = 0; i < pairs; ++i) {
    const std::size_t first = i * half / pairs;
    pair.trains = {static_cast<std::int32_t>(first + half)};
    pair.measure(descriptors, first, descriptors);
    unrelated_sum_ += static_cast<double>(match_distance(descriptors.norm(), pair.distances[0]));
  }
  unrelated_count_ += pairs;
}

/// Returns the limit as the kernels measure distances: bits, or the square. Only equal descriptors match as
/// long as no keyframe has had two descriptors.
std::int32_t PlaceIndex::max_measured() const {
  if (unrelated_count_ == 0) return 0;
  const double limit = options_.max_distance_share * unrelated_sum_ / static_cast<double>(unrelated_count_);
  const double measured = kind_.norm() == Norm::l2 ? limit * limit : limit;
  return static_cast<std::int32_t>(std::min(measured, static_cast<double>(kNoDistance - 1)));
}

void PlaceIndex::add(std::int32_t id, const Descriptors& descriptors) {
  require(!contains(id), "an id is added once");
  if (descriptors.count() > 0) {
    take_kind(descriptors);
    measure_unrelated(descriptors);
  }
  const auto slot = static_cast<Slot>(keyframes_.size());
  keyframes_.push_back({id, descriptors.count(), true});
  slots_.emplace(id, slot);
  for (std::size_t i = 0; i < descriptors.count(); ++i) tree_->add(descriptors, i, slot);
  rows_ += descriptors.count();
}

void PlaceIndex::remove(std::int32_t id) {
  const auto found = slots_.find(id);
  require(found != slots_.end(), "what is removed is in the index");
  Keyframe& keyframe = keyframes_[static_cast<std::size_t>(found->second)];
  keyframe.present = false;
  rows_removed_ += keyframe.descriptors;
  slots_.erase(found);
  // A pass over the tree when half of it is waste: its cost is spread over as many rows that were removed.
  if (rows_removed_ * 2 <= rows_ || !tree_) return;
  tree_->keep([&](Slot slot) { return keyframes_[static_cast<std::size_t>(slot)].present; });
  rows_ -= std::exchange(rows_removed_, 0);
}

std::vector<char> PlaceIndex::admitted(const std::function<bool(std::int32_t)>& admit) const {
  std::vector<char> result;
  result.reserve(keyframes_.size());
  for (const Keyframe& keyframe : keyframes_)
    result.push_back(keyframe.present && (!admit || admit(keyframe.id)) ? 1 : 0);
  return result;
}

std::vector<PlaceCandidate> PlaceIndex::query(const Descriptors& descriptors, std::size_t max_candidates,
                                              const std::function<bool(std::int32_t)>& admit) const {
  if (!tree_ || descriptors.count() == 0) return {};
  require_comparable(descriptors, kind_);
  const std::vector<char> open = admitted(admit);
  const std::vector<Vote> votes = collect_votes(
      *tree_, descriptors, static_cast<std::size_t>(options_.leaves_per_descriptor), open, max_measured());
  if (votes.empty()) return {};
  const auto documents = static_cast<std::size_t>(std::count(open.begin(), open.end(), 1));
  const std::vector<double> scores =
      score(slots_by_query(votes, descriptors.count()), keyframes_.size(), documents);
  std::vector<PlaceCandidate> candidates;
  for (std::size_t slot = 0; slot < scores.size(); ++slot)
    if (scores[slot] > 0) candidates.push_back({keyframes_[slot].id, scores[slot]});
  keep_best(candidates, max_candidates);
  return candidates;
}

}  // namespace cairn
