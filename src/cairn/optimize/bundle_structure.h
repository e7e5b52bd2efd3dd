// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cairn/optimize/bundle_term.h"

namespace cairn {

/// Items by the group that they belong to: those of group g are members[begin[g]] to members[begin[g + 1]],
/// in the order given.
struct Groups {
  std::vector<std::size_t> begin;  ///< one more than there are groups
  std::vector<std::size_t> members;

  [[nodiscard]] std::span<const std::size_t> of(std::size_t group) const {
    return std::span(members).subspan(begin[group], begin[group + 1] - begin[group]);
  }
};

/// group_of[i] in [0, count).
[[nodiscard]] Groups group_items(std::span<const std::int32_t> group_of, std::size_t count);

/// What does not change while a bundle is adjusted. Free cameras are counted in their order: `free` below is
/// such a position. Terms lie by point, within a point those of free cameras first, in their order. A link is
/// a term of a free camera; links have the order of terms.
struct BundleStructure {
  std::vector<std::int32_t> free_cameras;  ///< positions in the problem
  std::vector<BundleTerm> terms;
  std::vector<std::size_t> term_begin;   ///< by point, and one more
  std::vector<std::size_t> link_begin;   ///< by point, and one more
  std::vector<std::int32_t> link_free;   ///< free camera of a link
  std::vector<std::int32_t> link_point;  ///< point of a link
  Groups links_of_free;                  ///< by free camera, increasing

  [[nodiscard]] std::size_t points() const { return term_begin.size() - 1; }
  /// Number of the point's terms that are links; they come first.
  [[nodiscard]] std::size_t links(std::size_t point) const {
    return link_begin[point + 1] - link_begin[point];
  }
};

/// PreconditionError for a problem that adjust_bundle does not take.
void require_bundle(const BundleProblem& problem);

/// A camera that sees a point twice is a PreconditionError.
[[nodiscard]] BundleStructure analyse_bundle(const BundleProblem& problem);

}  // namespace cairn
