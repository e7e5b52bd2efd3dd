// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "cairn/core/random.h"
#include "cairn/features/features.h"
#include "cairn/matching/kernels/distance_kernels.h"

namespace cairn {

/// Holds the options of a DescriptorTree.
struct DescriptorTreeOptions {
  int branching = 16;       ///< clusters that a full leaf is divided into; at least 2
  int leaf_capacity = 128;  ///< rows of a leaf, which are compared one by one; at least the branching
  std::uint64_t seed = 1;   ///< seed for the choice of centres

  /// Throws PreconditionError for a number out of its range.
  void validate() const;
};

/// Indexes descriptors, which are added one after the other, so that those like a given one are found without
/// comparing all: a tree of clusters whose centres are some of the descriptors themselves (Muja and Lowe
/// 2012, "Fast matching of binary features"), which needs nothing of a descriptor but distances. It grows by
/// dividing full leaves, as vocabulary trees do (Nister and Stewenius 2006), here while it is filled, and
/// keeps the descriptors, as Schlegel and Grisetti's (2018) binary search tree does. Every row is in one
/// leaf. The same calls in the same order make the same tree.
class DescriptorTree {
 public:
  /// Holds rows that are compared one by one: row i begins at rows[words * i], with `words` words of 64 bits
  /// per row.
  struct Leaf {
    std::vector<std::uint64_t> rows;
    std::vector<std::int32_t> owners;  ///< owner of each row
    std::size_t capacity = 0;          ///< rows that it takes before it is divided
  };

  /// Holds the tree without its rows, to be stored, and to find leaves whose rows are kept elsewhere.
  struct Branches {
    std::vector<std::int32_t> used;  ///< children of each branch, at most `branching`
    /// Children of branch b, from position b * branching on: a later branch, or ~leaf.
    std::vector<std::int32_t> children;
    std::vector<std::uint64_t> centres;  ///< centre of each child, one row for each position
    std::size_t leaves = 1;
  };

  /// Makes an empty tree for rows of the norm and size of `kind`. Throws PreconditionError for options out of
  /// range.
  DescriptorTree(const Descriptors& kind, const DescriptorTreeOptions& options);
  /// Makes a tree with the given branches and empty leaves. Throws PreconditionError if they are not those of
  /// a tree (is_tree).
  DescriptorTree(const Descriptors& kind, const DescriptorTreeOptions& options, Branches branches);
  /// Returns a copy of the tree without its rows.
  [[nodiscard]] Branches branches() const { return {used_, children_, centres_, leaves_.size()}; }

  /// Adds row `i` of `descriptors`, which are of the tree's kind, for an owner.
  void add(const Descriptors& descriptors, std::size_t i, std::int32_t owner);

  /// Removes the rows of owners that are not `kept`.
  void keep(const std::function<bool(std::int32_t owner)>& kept);

  /// Says that a leaf may have rows like descriptor `query` of the queries.
  struct Visit {
    std::int32_t leaf, query;
    bool operator<(const Visit& other) const {
      return leaf != other.leaf ? leaf < other.leaf : query < other.query;
    }
  };

  /// Finds for each of `queries`, which are of the tree's kind, at most `most` leaves: the one of the nearest
  /// centres, and those for which distances to centres would have to change least. Returns them in ascending
  /// order.
  [[nodiscard]] std::vector<Visit> find_leaves(const Descriptors& queries, std::size_t most) const;

  [[nodiscard]] std::size_t leaf_count() const { return leaves_.size(); }
  [[nodiscard]] const Leaf& leaf(std::int32_t index) const {
    return leaves_[static_cast<std::size_t>(index)];
  }

  /// Computes the distances, as the kernels measure them, from row `i` of `queries` to all rows of a leaf.
  void measure(const Descriptors& queries, std::size_t i, const Leaf& leaf,
               std::vector<std::int32_t>& distances) const {
    measure(queries.words() + i * words_, leaf.rows.data(), leaf.owners.size(), distances);
  }

  /// Computes the distances, as the kernels measure them, from row `i` of `queries` to rows that are kept
  /// elsewhere, one after the other; `ascending` is 0, 1, ... up to their number less one.
  void measure_rows(const Descriptors& queries, std::size_t i, const std::uint64_t* rows,
                    std::span<const std::int32_t> ascending, std::vector<std::int32_t>& distances) const;

  /// Prefetches the leaves that come soon after visit `at`.
  void fetch_ahead(std::span<const Visit> visits, std::size_t at) const;

 private:
  /// Index of a branch, or the complement of that of a leaf.
  using Child = std::int32_t;
  /// Holds a child that was passed by, and how much nearer the centres preferred to it were.
  struct Detour {
    std::int64_t cost;
    Child child;
    bool operator<(const Detour& other) const {
      return cost != other.cost ? cost < other.cost : child < other.child;
    }
  };

  /// Holds how far the search for the leaves of one row has come.
  struct Descent {
    Detour at{0, ~0};
    std::vector<Detour> passed;  // the cheapest, ascending, as many as are wanted
    std::size_t wanted = 0;      // leaves still to be found after that of `at`
    bool ended = false;

    void take_cheapest();
  };

  [[nodiscard]] Child root() const { return used_.empty() ? ~0 : 0; }
  void measure(const std::uint64_t* row, const std::uint64_t* rows, std::size_t count,
               std::vector<std::int32_t>& distances) const;
  void measure(const std::uint64_t* row, const std::uint64_t* rows, std::span<const std::int32_t> ascending,
               std::vector<std::int32_t>& distances) const;
  /// Returns the index in children_ of the child of `branch` whose centre is nearest; `distances` receives
  /// those to all centres.
  std::size_t nearest_child(const std::uint64_t* row, Child branch,
                            std::vector<std::int32_t>& distances) const;
  void step_down(const std::uint64_t* row, Descent& descent, std::vector<std::int32_t>& distances) const;
  void descend(const Descriptors& queries, std::vector<Descent>& descents) const;
  void fetch_branch(Child branch) const;
  [[nodiscard]] std::vector<std::uint64_t> choose_centres(const Leaf& leaf);
  void cut(std::size_t place);
  std::int32_t append_branch(const std::vector<std::uint64_t>& centres);
  void append(Leaf& leaf, const std::uint64_t* row, std::int32_t owner);

  DescriptorTreeOptions options_;
  const DistanceKernels* kernels_;
  std::size_t words_;    // of 64 bits, of one row
  std::size_t fan_out_;  // places for children of each branch
  Random random_;
  std::vector<std::int32_t> used_;      // of these places, by branch
  std::vector<Child> children_;         // of branch b from b * fan_out_ on
  std::vector<std::uint64_t> centres_;  // of child i from i * words_ on
  std::vector<Leaf> leaves_;
  std::vector<std::int32_t> ascending_;  // 0, 1, ... as many as the largest leaf has rows, for the kernels
};

/// Returns whether the branches are those of a tree: every child is a later branch or an existing leaf, so
/// that each path from the root ends in a leaf. A row has `words` words of 64 bits.
[[nodiscard]] bool is_tree(const DescriptorTree::Branches& branches, std::size_t branching,
                           std::size_t words);

}  // namespace cairn
