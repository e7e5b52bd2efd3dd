// SPDX-License-Identifier: Apache-2.0
#include "cairn/places/descriptor_tree.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

#include "cairn/core/error.h"
#include "cairn/matching/packed_descriptors.h"

namespace cairn {
namespace {

constexpr auto kNowhere = static_cast<std::size_t>(-1);  // the place of a leaf that is the whole tree
constexpr std::size_t kLineBytes = 64;                   // of a cache

/// Appends with room for a few more values only: most leaves are small, and memory is what limits the tree.
template <class T>
void append_sparingly(std::vector<T>& values, const T* begin, std::size_t count) {
  constexpr std::size_t kFewestMore = 8, kShareMore = 8;
  const std::size_t needed = values.size() + count;
  if (needed > values.capacity()) values.reserve(needed + std::max(kFewestMore * count, needed / kShareMore));
  values.insert(values.end(), begin, begin + count);
}

const DescriptorTreeOptions& validated(const DescriptorTreeOptions& options) {
  options.validate();
  return options;
}

/// Returns the index of the leaf that a child is.
std::size_t leaf_index(std::int32_t child) {
  const std::int32_t index = ~child;
  return static_cast<std::size_t>(index);
}

template <class T>
void fetch_lines(const T* begin, std::size_t count) {
  for (std::size_t i = 0; i < count; i += kLineBytes / sizeof(T)) __builtin_prefetch(begin + i);
}

std::size_t index_of_smallest(const std::vector<std::int32_t>& distances) {
  return static_cast<std::size_t>(std::min_element(distances.begin(), distances.end()) - distances.begin());
}

}  // namespace

bool is_tree(const DescriptorTree::Branches& branches, std::size_t fan_out, std::size_t words) {
  const std::size_t count = branches.used.size();
  if (branches.children.size() != count * fan_out || branches.centres.size() != count * fan_out * words ||
      branches.leaves == 0)
    return false;
  for (std::size_t branch = 0; branch < count; ++branch) {
    const auto used = static_cast<std::size_t>(branches.used[branch]);
    if (used == 0 || used > fan_out) return false;
    for (std::size_t i = 0; i < used; ++i) {
      const std::int32_t child = branches.children[branch * fan_out + i];
      const bool later =
          child >= 0 && static_cast<std::size_t>(child) > branch && static_cast<std::size_t>(child) < count;
      if (!later && (child >= 0 || leaf_index(child) >= branches.leaves)) return false;
    }
  }
  return true;
}

void DescriptorTreeOptions::validate() const {
  require(branching >= 2, "a cluster is cut into two at least");
  require(leaf_capacity >= branching, "a full leaf has a row for every centre");
}

DescriptorTree::DescriptorTree(const Descriptors& kind, const DescriptorTreeOptions& options)
    : options_(validated(options)),
      kernels_(&distance_kernels(kind.norm())),
      words_(kind.stride() / 8),
      fan_out_(static_cast<std::size_t>(options.branching)),
      random_(options.seed),
      leaves_(1),
      ascending_(static_cast<std::size_t>(options.leaf_capacity) + 1) {
  require(words_ > 0, "descriptors have a length");
  leaves_[0].capacity = static_cast<std::size_t>(options.leaf_capacity);
  std::iota(ascending_.begin(), ascending_.end(), 0);
}

DescriptorTree::DescriptorTree(const Descriptors& kind, const DescriptorTreeOptions& options,
                               Branches branches)
    : DescriptorTree(kind, options) {
  require(is_tree(branches, fan_out_, words_), "the branches are those of a tree");
  used_ = std::move(branches.used);
  children_ = std::move(branches.children);
  centres_ = std::move(branches.centres);
  leaves_.resize(branches.leaves);
}

void DescriptorTree::measure_rows(const Descriptors& queries, std::size_t i, const std::uint64_t* rows,
                                  std::span<const std::int32_t> ascending,
                                  std::vector<std::int32_t>& distances) const {
  measure(queries.words() + i * words_, rows, ascending, distances);
}

void DescriptorTree::measure(const std::uint64_t* row, const std::uint64_t* rows, std::size_t count,
                             std::vector<std::int32_t>& distances) const {
  measure(row, rows, std::span(ascending_).first(count), distances);
}

void DescriptorTree::measure(const std::uint64_t* row, const std::uint64_t* rows,
                             std::span<const std::int32_t> ascending,
                             std::vector<std::int32_t>& distances) const {
  distances.resize(ascending.size());
  DistanceList list;
  list.query = reinterpret_cast<const std::uint8_t*>(row);
  list.rows = reinterpret_cast<const std::uint8_t*>(rows);
  list.words64 = words_;
  list.indices = ascending.data();
  list.count = ascending.size();
  list.distances = distances.data();
  kernels_->to_rows(list);
}

std::size_t DescriptorTree::nearest_child(const std::uint64_t* row, Child branch,
                                          std::vector<std::int32_t>& distances) const {
  const auto index = static_cast<std::size_t>(branch);
  measure(row, centres_.data() + index * fan_out_ * words_, static_cast<std::size_t>(used_[index]),
          distances);
  return index * fan_out_ + index_of_smallest(distances);
}

void DescriptorTree::fetch_branch(Child branch) const {
  const std::size_t begin = static_cast<std::size_t>(branch) * fan_out_;
  fetch_lines(centres_.data() + begin * words_, fan_out_ * words_);
  fetch_lines(children_.data() + begin, fan_out_);
}

void DescriptorTree::fetch_ahead(std::span<const Visit> visits, std::size_t at) const {
  constexpr std::size_t kLeavesAhead = 8, kRowsAhead = 3;  // where the rows are has to be known before them
  if (at + kLeavesAhead < visits.size()) __builtin_prefetch(&leaf(visits[at + kLeavesAhead].leaf));
  if (at + kRowsAhead >= visits.size()) return;
  const Leaf& soon = leaf(visits[at + kRowsAhead].leaf);
  fetch_lines(soon.rows.data(), soon.rows.size());
}

void DescriptorTree::append(Leaf& leaf, const std::uint64_t* row, std::int32_t owner) {
  append_sparingly(leaf.rows, row, words_);
  append_sparingly(leaf.owners, &owner, 1);
  if (leaf.owners.size() > ascending_.size())
    ascending_.push_back(static_cast<std::int32_t>(ascending_.size()));
}

void DescriptorTree::add(const Descriptors& descriptors, std::size_t i, std::int32_t owner) {
  const std::uint64_t* row = descriptors.words() + i * words_;
  std::vector<std::int32_t> distances;
  Child at = root();
  std::size_t place = kNowhere;
  while (at >= 0) {
    place = nearest_child(row, at, distances);
    at = children_[place];
  }
  Leaf& leaf = leaves_[leaf_index(at)];
  append(leaf, row, owner);
  if (leaf.owners.size() > leaf.capacity) cut(place);
}

/// Chooses at most `branching` rows of a leaf, no two equal, one after the other.
std::vector<std::uint64_t> DescriptorTree::choose_centres(const Leaf& leaf) {
  std::vector<std::uint32_t> order(leaf.owners.size());
  std::iota(order.begin(), order.end(), 0U);
  std::vector<std::uint64_t> centres;
  std::vector<std::int32_t> distances;
  for (std::size_t i = 0; i < static_cast<std::size_t>(options_.branching); ++i) {
    std::swap(order[i], order[i + random_.index(static_cast<std::uint32_t>(order.size() - i))]);
    const std::uint64_t* row = leaf.rows.data() + order[i] * words_;
    measure(row, centres.data(), centres.size() / words_, distances);
    if (std::find(distances.begin(), distances.end(), 0) != distances.end()) continue;
    centres.insert(centres.end(), row, row + words_);
  }
  return centres;
}

/// Appends a branch with the given centres and no leaves yet.
std::int32_t DescriptorTree::append_branch(const std::vector<std::uint64_t>& centres) {
  const auto branch = static_cast<Child>(used_.size());
  used_.push_back(static_cast<std::int32_t>(centres.size() / words_));
  children_.resize(children_.size() + fan_out_);
  centres_.insert(centres_.end(), centres.begin(), centres.end());
  centres_.resize(children_.size() * words_);
  return branch;
}

/// Divides the leaf at `place`: its rows go to one leaf for each centre, and a branch takes its place. If all
/// centres are equal, there is nothing to divide, and the leaf may grow to twice the size.
void DescriptorTree::cut(std::size_t place) {
  const std::size_t index = place == kNowhere ? 0 : leaf_index(children_[place]);
  const std::vector<std::uint64_t> centres = choose_centres(leaves_[index]);
  if (centres.size() < 2 * words_) {
    leaves_[index].capacity *= 2;
    return;
  }
  const Leaf whole = std::exchange(leaves_[index], Leaf());
  const Child branch = append_branch(centres);
  if (place != kNowhere) children_[place] = branch;
  const std::size_t begin = static_cast<std::size_t>(branch) * fan_out_;
  for (std::size_t i = 0; i < centres.size() / words_; ++i) {
    if (i > 0) leaves_.emplace_back();
    const std::size_t leaf = i > 0 ? leaves_.size() - 1 : index;
    leaves_[leaf].capacity = whole.capacity;
    children_[begin + i] = ~static_cast<Child>(leaf);
  }
  std::vector<std::int32_t> distances;
  for (std::size_t i = 0; i < whole.owners.size(); ++i) {
    const std::uint64_t* row = whole.rows.data() + i * words_;
    const std::size_t child = nearest_child(row, branch, distances);
    append(leaves_[leaf_index(children_[child])], row, whole.owners[i]);
  }
}

void DescriptorTree::keep(const std::function<bool(std::int32_t owner)>& kept) {
  for (Leaf& leaf : leaves_) {
    Leaf rest;
    rest.capacity = leaf.capacity;
    for (std::size_t i = 0; i < leaf.owners.size(); ++i)
      if (kept(leaf.owners[i])) append(rest, leaf.rows.data() + i * words_, leaf.owners[i]);
    leaf = std::move(rest);
  }
}

void DescriptorTree::Descent::take_cheapest() {
  ended = passed.empty();
  if (ended) return;
  at = passed.front();
  passed.erase(passed.begin());
  --wanted;
}

/// Steps from a branch to its nearest child, and remembers the others as far as they may be wanted.
void DescriptorTree::step_down(const std::uint64_t* row, Descent& descent,
                               std::vector<std::int32_t>& distances) const {
  const std::size_t nearest = nearest_child(row, descent.at.child, distances);
  const std::size_t begin = static_cast<std::size_t>(descent.at.child) * fan_out_;
  std::vector<Detour>& passed = descent.passed;
  for (std::size_t i = 0; i < distances.size() && descent.wanted > 0; ++i) {
    const Detour detour{descent.at.cost + distances[i] - distances[nearest - begin], children_[begin + i]};
    if (begin + i == nearest || (passed.size() == descent.wanted && passed.back() < detour)) continue;
    if (passed.size() == descent.wanted) passed.pop_back();
    passed.insert(std::upper_bound(passed.begin(), passed.end(), detour), detour);
  }
  descent.at.child = children_[nearest];
}

/// Takes all descents to leaves, by turns, so that the memory has time to bring what each needs next.
void DescriptorTree::descend(const Descriptors& queries, std::vector<Descent>& descents) const {
  std::vector<std::int32_t> distances;
  for (bool moved = true; moved;) {
    moved = false;
    for (std::size_t q = 0; q < descents.size(); ++q) {
      if (descents[q].at.child < 0) continue;
      step_down(queries.words() + q * words_, descents[q], distances);
      if (descents[q].at.child >= 0) fetch_branch(descents[q].at.child);
      moved = true;
    }
  }
}

std::vector<DescriptorTree::Visit> DescriptorTree::find_leaves(const Descriptors& queries,
                                                               std::size_t most) const {
  std::vector<Visit> visits;
  if (most == 0) return visits;
  Descent start;
  start.at.child = root();
  start.wanted = most - 1;
  std::vector<Descent> descents(queries.count(), start);
  for (std::size_t found = 0; found < most; ++found) {
    descend(queries, descents);
    for (std::size_t q = 0; q < descents.size(); ++q) {
      if (descents[q].ended) continue;
      visits.push_back({~descents[q].at.child, static_cast<std::int32_t>(q)});
      descents[q].take_cheapest();
    }
  }
  std::sort(visits.begin(), visits.end());
  return visits;
}

}  // namespace cairn
