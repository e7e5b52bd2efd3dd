// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "cairn/features/features.h"
#include "cairn/places/descriptor_tree.h"

namespace cairn {

/// Holds a keyframe that may show the place asked for.
struct PlaceCandidate {
  std::int32_t id = 0;
  double score = 0;  ///< share of the query's weight that matches this keyframe, in (0, 1]
  bool operator==(const PlaceCandidate&) const = default;
};

/// Holds the options of a PlaceIndex.
struct PlaceIndexOptions {
  /// Largest distance of descriptors that show one point, as a share of the mean distance of descriptors that
  /// show different ones, which the index measures. ORB: 55 bits of 122; SIFT: 230 of 510.
  double max_distance_share = 0.45;
  /// Leaves of the tree that are searched for each descriptor: a second one finds neighbours across a border;
  /// further ones hardly find better places.
  int leaves_per_descriptor = 2;
  DescriptorTreeOptions tree = {};

  /// Throws PreconditionError for a number out of its range.
  void validate() const;
};

/// Finds the keyframes that look like an image, whatever the poses. It needs no vocabulary from elsewhere:
/// the keyframes' own descriptors, of any norm and size, are kept in a DescriptorTree, which grows with the
/// map.
///
/// Descriptor i of a query matches keyframe k if one of k's is at most the limit away and is nearer to no
/// other descriptor of the query (so that one thing seen once is not counted twice); this is voting in an
/// inverted file with the descriptor itself to check what a cell alone cannot tell (Jegou, Douze and Schmid
/// 2008, sec. 4). If n_i of N keyframes match it, it weighs w_i = ln((N + 1) / max(n_i, 1)), the inverse
/// document frequency (Sparck Jones 1972; Sivic and Zisserman 2003) without words: texture that is everywhere
/// weighs nothing. The score is sum of w_i over what k matches / sum of all w_i. Keyframes that are not
/// admitted count in neither n_i nor N.
///
/// Results depend on the calls and their order alone. Several threads may query at once, but not while
/// another adds or removes.
class PlaceIndex {
 public:
  explicit PlaceIndex(const PlaceIndexOptions& options = {});

  /// Adds a keyframe. Throws PreconditionError if the id is in the index, or if the descriptors are of
  /// another kind than those before.
  void add(std::int32_t id, const Descriptors& descriptors);

  /// Removes a keyframe. Throws PreconditionError if the id is not in the index.
  void remove(std::int32_t id);

  [[nodiscard]] std::size_t size() const { return slots_.size(); }
  [[nodiscard]] bool contains(std::int32_t id) const { return slots_.count(id) > 0; }

  /// Returns at most `max_candidates` keyframes with a positive score, best first, and the lower id first if
  /// equal. `admit` says which ids are admitted; without it all are. It is called once for each, in no
  /// particular order. Throws PreconditionError for descriptors of another kind.
  [[nodiscard]] std::vector<PlaceCandidate> query(const Descriptors& descriptors, std::size_t max_candidates,
                                                  const std::function<bool(std::int32_t)>& admit = {}) const;

 private:
  /// Position of a keyframe in the order of addition, which is used once.
  using Slot = std::int32_t;
  struct Keyframe {
    std::int32_t id;
    std::size_t descriptors;
    bool present;
  };

  void take_kind(const Descriptors& descriptors);
  void measure_unrelated(const Descriptors& descriptors);
  [[nodiscard]] std::int32_t max_measured() const;
  [[nodiscard]] std::vector<char> admitted(const std::function<bool(std::int32_t)>& admit) const;

  PlaceIndexOptions options_;
  Descriptors kind_;                         // an empty one, of the kind that all are
  std::optional<DescriptorTree> tree_;       // its owners are slots
  std::vector<Keyframe> keyframes_;          // by slot
  std::map<std::int32_t, Slot> slots_;       // by id, of those present
  std::size_t rows_ = 0, rows_removed_ = 0;  // in the tree
  double unrelated_sum_ = 0;                 // of distances
  std::size_t unrelated_count_ = 0;
};

}  // namespace cairn
