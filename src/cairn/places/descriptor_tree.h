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

struct DescriptorTreeOptions {
  int branching = 16;       ///< at least 2: clusters that a full leaf is cut into
  int leaf_capacity = 128;  ///< at least the branching: so many rows are compared one by one
  std::uint64_t seed = 1;   ///< of the choice of centres

  /// PreconditionError for a number out of its range.
  void validate() const;
};

/// Descriptors that come one after the other, so ordered that those like a given one are found without
/// looking at all: a tree of clusters whose centres are some of the descriptors themselves (Muja and Lowe
/// 2012, "Fast matching of binary features"), which asks nothing of a descriptor but distances. It grows by
/// cutting what is full, as vocabulary trees do (Nister and Stewenius 2006), here while it is filled, and
/// keeps the descriptors, as Schlegel and Grisetti's (2018) binary search tree does. Every row is in one
/// leaf. The same calls in the same order make the same tree.
class DescriptorTree {
 public:
  /// Where rows are compared one by one: row i begins at 8 * words * i.
  struct Leaf {
    std::vector<std::uint64_t> rows;
    std::vector<std::int32_t> owners;  ///< of each row
    std::size_t capacity = 0;          ///< rows that it takes before it is cut
  };

  /// All but the rows: to be stored, and to find leaves again whose rows are kept elsewhere.
  struct Branches {
    std::vector<std::int32_t> used;      ///< places of each branch that have a child, of `branching`
    std::vector<std::int32_t> children;  ///< of branch b from b * branching on: a later branch, or ~leaf
    std::vector<std::uint64_t> centres;  ///< one row for each place
    std::size_t leaves = 1;
  };

  /// `kind`: of what norm and size the rows are.
  DescriptorTree(const Descriptors& kind, const DescriptorTreeOptions& options);
  /// A tree with these branches and empty leaves. PreconditionError where they are of no tree.
  DescriptorTree(const Descriptors& kind, const DescriptorTreeOptions& options, Branches branches);
  [[nodiscard]] Branches branches() const { return {used_, children_, centres_, leaves_.size()}; }

  /// Adds row `i` of `descriptors`, which are of the tree's kind.
  void add(const Descriptors& descriptors, std::size_t i, std::int32_t owner);

  /// Drops the rows of owners that are not `kept`.
  void keep(const std::function<bool(std::int32_t owner)>& kept);

  /// A descriptor of a query and a leaf where rows like it may be.
  struct Visit {
    std::int32_t leaf, query;
    bool operator<(const Visit& other) const {
      return leaf != other.leaf ? leaf < other.leaf : query < other.query;
    }
  };

  /// For each of `queries`, which are of the tree's kind, as many as `most` leaves: the one of the nearest
  /// centres, and those for which the fewest distance would have to change. In ascending order.
  [[nodiscard]] std::vector<Visit> find_leaves(const Descriptors& queries, std::size_t most) const;

  [[nodiscard]] std::size_t leaf_count() const { return leaves_.size(); }
  [[nodiscard]] const Leaf& leaf(std::int32_t index) const {
    return leaves_[static_cast<std::size_t>(index)];
  }

  /// Distances, as the kernels measure them, from row `i` of `queries` to all rows of a leaf.
  void measure(const Descriptors& queries, std::size_t i, const Leaf& leaf,
               std::vector<std::int32_t>& distances) const {
    measure(queries.words() + i * words_, leaf.rows.data(), leaf.owners.size(), distances);
  }

  /// The same to `count` rows that are kept elsewhere, one after the other; `ascending` has 0, 1, ... as
  /// many.
  void measure_rows(const Descriptors& queries, std::size_t i, const std::uint64_t* rows,
                    std::span<const std::int32_t> ascending, std::vector<std::int32_t>& distances) const;

  /// Asks the memory for leaves that come soon after visit `at`, so that it need not be waited for.
  void fetch_ahead(std::span<const Visit> visits, std::size_t at) const;

 private:
  /// A branch's index, or the complement of a leaf's.
  using Child = std::int32_t;
  /// A child that was passed by, and by how much nearer the centres preferred to it were.
  struct Detour {
    std::int64_t cost;
    Child child;
    bool operator<(const Detour& other) const {
      return cost != other.cost ? cost < other.cost : child < other.child;
    }
  };

  /// Where the search for the leaves of one row is.
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
  /// Index in children_ of the child of `branch` whose centre is nearest; `distances` to all centres.
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

/// Whether every child is a later branch or a leaf that there is, so that each way from the root ends in a
/// leaf. `words` of 64 bits are one row.
[[nodiscard]] bool is_tree(const DescriptorTree::Branches& branches, std::size_t branching,
                           std::size_t words);

}  // namespace cairn
