// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "cairn/map_files/map_info.h"
#include "cairn/map_files/mapped_file.h"
#include "cairn/map_files/place_layout.h"
#include "cairn/places/descriptor_tree.h"

namespace cairn {

/// Writes Place.bin of the map in `folder`, whose Point.bin and Descriptor.bin are there as announced by
/// `info`: one of four of each landmark's descriptors, in the leaves of a DescriptorTree. Memory does not
/// grow with the map: the tree is built of a sample, and the rows are put in their positions in files in the
/// folder `scratch`, which are gone afterwards. Returns the checksum that the file ends with.
std::uint32_t write_place_file(const std::filesystem::path& folder, const MapInfo& info,
                               const std::filesystem::path& scratch);

/// Maps Place.bin into memory: landmarks by what they look like, and the keyframes that show a landmark. Safe
/// to use from several threads.
class PlaceFile {
 public:
  /// Opens Place.bin of the map in `folder`. Throws InputError if it is missing, damaged, or not as announced
  /// by `info`.
  PlaceFile(const std::filesystem::path& folder, const MapInfo& info);

  /// Says that a descriptor of a landmark is near a query; `distance` is as the kernels measure it.
  struct Neighbour {
    std::uint32_t landmark = 0;
    std::int32_t distance = 0;
  };
  using Neighbours = std::vector<Neighbour>;  ///< nearest first; a landmark may be there more than once

  /// Finds for each query the stored descriptors within `max_distance_share` of the mean distance of
  /// unrelated ones, in `leaves_per_descriptor` leaves of the tree. Throws PreconditionError for descriptors
  /// of another kind.
  [[nodiscard]] std::vector<Neighbours> find(const Descriptors& queries, double max_distance_share,
                                             std::size_t leaves_per_descriptor) const;

  /// Returns how many distances `find` has computed so far, in all threads.
  [[nodiscard]] std::uint64_t compared_rows() const { return compared_rows_.load(std::memory_order_relaxed); }
  /// Returns how much of the file was read so far, bytes, see MappedFile.
  [[nodiscard]] std::uint64_t touched_bytes() const { return file_.touched_bytes(); }

  /// Returns the keyframes of `count` rows of Descriptor.bin, from `first_row` on.
  [[nodiscard]] std::span<const std::int32_t> keyframes(std::uint64_t first_row, std::uint32_t count) const;

  /// Returns how many landmarks each keyframe shows.
  [[nodiscard]] const std::vector<std::uint32_t>& shown_landmarks() const { return shown_landmarks_; }

 private:
  void count_shown_landmarks();
  [[nodiscard]] DescriptorTree::Branches read_branches() const;
  struct LeafRows {
    std::uint64_t first = 0, count = 0;
  };
  [[nodiscard]] LeafRows rows_of(std::int32_t leaf) const;
  void fetch_leaf(std::int32_t leaf) const;
  void visit(std::span<const DescriptorTree::Visit> visits, const Descriptors& queries, std::int32_t limit,
             std::vector<Neighbours>& found) const;

  MappedFile file_;
  Descriptors kind_;  // an empty one
  PlaceHeader header_;
  PlaceLayout layout_;
  std::uint64_t landmarks_ = 0, keyframes_ = 0;  // that there are
  std::vector<std::uint32_t> shown_landmarks_;
  mutable std::atomic<std::uint64_t> compared_rows_ = 0;
  std::optional<DescriptorTree> tree_;  // nothing where the map has no descriptors
};

}  // namespace cairn
