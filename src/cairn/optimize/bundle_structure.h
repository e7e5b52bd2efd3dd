// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cairn/optimize/bundle_term.h"

namespace cairn {

/// Lists items by their group: those of group g are members[begin[g]] to members[begin[g + 1]], in the order
/// given.
struct Groups {
  std::vector<std::size_t> begin;  ///< begin of each group, and the number of members
  std::vector<std::size_t> members;

  [[nodiscard]] std::span<const std::size_t> of(std::size_t group) const {
    return std::span(members).subspan(begin[group], begin[group + 1] - begin[group]);
  }
};

/// Lists items 0, 1, ... by their group; group_of[i] is in [0, count).
[[nodiscard]] Groups group_items(std::span<const std::int32_t> group_of, std::size_t count);

/// Describes what does not change during an adjustment: the free cameras, the points that are seen, and the
/// terms, which are ordered by point, and within a point with those of free cameras first. A link is a term
/// of a free camera; links have the order of terms. `free` and `point` are positions in `free_cameras` and
/// `points`.
struct BundleStructure {
  std::vector<std::int32_t> free_cameras;  ///< positions in the problem, increasing
  std::vector<std::int32_t> points;        ///< positions in the problem, ordered by the first camera
  std::vector<BundleTerm> terms;
  std::vector<std::size_t> term_begin;   ///< begin of each point in `terms`, and their number
  std::vector<std::size_t> link_begin;   ///< begin of each point in the links, and their number
  std::vector<std::int32_t> link_free;   ///< free camera of a link; increases within a point
  std::vector<std::int32_t> link_point;  ///< point of a link
  Groups links_of_free;                  ///< by free camera, increasing
  /// One for each free camera; without information if the problem has none of it.
  std::vector<CameraPrior> prior_of_free;

  /// Returns the number of the point's terms that are links; they come first.
  [[nodiscard]] std::size_t links(std::size_t point) const {
    return link_begin[point + 1] - link_begin[point];
  }
  /// Begins the point at this position in the problem: terms and links appended afterwards belong to it.
  void begin_point(std::int32_t point);
};

/// Throws PreconditionError if `problem` is invalid as described for adjust_bundle, except for a camera that
/// sees a point twice, which analyse_bundle finds.
void require_bundle(const BundleProblem& problem);

/// Computes the structure of a valid problem. Throws PreconditionError if a camera sees a point twice.
[[nodiscard]] BundleStructure analyse_bundle(const BundleProblem& problem);

}  // namespace cairn
