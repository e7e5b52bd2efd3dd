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

/// What does not change while a bundle is adjusted: the free cameras, the points that are seen, and terms,
/// which lie by point, within a point those of free cameras first. A link is a term of a free camera; links
/// have the order of terms. Below, `free` and `point` are positions in the first two.
struct BundleStructure {
  std::vector<std::int32_t> free_cameras;  ///< positions in the problem, increasing
  std::vector<std::int32_t> points;        ///< positions in the problem, by the first camera
  std::vector<BundleTerm> terms;
  std::vector<std::size_t> term_begin;   ///< by point, and one more
  std::vector<std::size_t> link_begin;   ///< by point, and one more
  std::vector<std::int32_t> link_free;   ///< free camera of a link; increases within a point
  std::vector<std::int32_t> link_point;  ///< point of a link
  Groups links_of_free;                  ///< by free camera, increasing

  /// Number of the point's terms that are links; they come first.
  [[nodiscard]] std::size_t links(std::size_t point) const {
    return link_begin[point + 1] - link_begin[point];
  }
  /// What is appended from here on belongs to the point at this position in the problem.
  void begin_point(std::int32_t point);
};

/// PreconditionError for a problem that adjust_bundle does not take.
void require_bundle(const BundleProblem& problem);

/// A camera that sees a point twice is a PreconditionError.
[[nodiscard]] BundleStructure analyse_bundle(const BundleProblem& problem);

}  // namespace cairn
