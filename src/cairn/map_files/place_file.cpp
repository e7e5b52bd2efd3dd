// SPDX-License-Identifier: Apache-2.0
#include "cairn/map_files/place_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "cairn/core/error.h"
#include "cairn/matching/packed_descriptors.h"

namespace cairn {

PlaceFile::PlaceFile(const std::filesystem::path& folder, const MapInfo& info)
    : file_(folder / kPlaceFile, kPlaceKind, info.checksum_of(kPlaceFile)) {
  header_ = get_place_header(file_);
  if (header_.bytes != info.descriptor.bytes ||
      header_.norm != static_cast<std::uint32_t>(info.descriptor.norm))
    file_.fail(fmt::format("descriptors of {} bytes, as map.json says", info.descriptor.bytes),
               fmt::format("{} bytes with norm number {}", header_.bytes, header_.norm));
  if (header_.observations != info.observations)
    file_.fail(fmt::format("{} sightings, as map.json says", info.observations),
               fmt::format("{}", header_.observations));
  if (!is_possible(header_, file_.size())) file_.fail("counts that fit the size of the file", "others");
  layout_ = layout_of(header_);
  landmarks_ = info.landmarks;
  keyframes_ = info.keyframes.size();
  count_shown_landmarks();
  kind_ = Descriptors(info.descriptor.norm, info.descriptor.bytes, 0);
  if (header_.bytes > 0)
    tree_.emplace(kind_, DescriptorTreeOptions{static_cast<int>(header_.branching)}, read_branches());
}

void PlaceFile::count_shown_landmarks() {
  shown_landmarks_.resize(keyframes_);
  for (const std::int32_t keyframe : file_.values<std::int32_t>(layout_.keyframes, header_.observations)) {
    if (keyframe < 0 || static_cast<std::uint64_t>(keyframe) >= keyframes_)
      file_.fail(fmt::format("a keyframe below {}", keyframes_), fmt::format("{}", keyframe));
    ++shown_landmarks_[static_cast<std::size_t>(keyframe)];
  }
}

DescriptorTree::Branches PlaceFile::read_branches() const {
  const auto copy = [](auto values) { return std::vector(values.begin(), values.end()); };
  const std::uint64_t places = std::uint64_t{header_.branches} * header_.branching;
  DescriptorTree::Branches branches{
      copy(file_.values<std::int32_t>(layout_.used, header_.branches)),
      copy(file_.values<std::int32_t>(layout_.children, places)),
      copy(file_.values<std::uint64_t>(layout_.centres, places * kind_.stride() / 8)), header_.leaves};
  if (!is_tree(branches, header_.branching, kind_.stride() / 8)) file_.fail("a tree", "branches of none");
  return branches;
}

PlaceFile::LeafRows PlaceFile::rows_of(std::int32_t leaf) const {
  const auto bounds =
      file_.values<std::uint64_t>(layout_.leaf_begins + 8 * static_cast<std::uint64_t>(leaf), 2);
  if (bounds[0] > bounds[1] || bounds[1] > header_.rows) file_.fail("leaves one after the other", "others");
  return {bounds[0], bounds[1] - bounds[0]};
}

void PlaceFile::visit(std::span<const DescriptorTree::Visit> visits, const Descriptors& queries,
                      std::int32_t limit, std::vector<Neighbours>& found) const {
  const LeafRows leaf = rows_of(visits.front().leaf);
  const std::size_t stride = kind_.stride();
  const auto rows = file_.values<std::uint64_t>(layout_.rows + leaf.first * stride, leaf.count * stride / 8);
  const auto landmarks = file_.values<std::uint32_t>(layout_.landmarks + 4 * leaf.first, leaf.count);
  compared_rows_.fetch_add(leaf.count * visits.size(), std::memory_order_relaxed);
  std::vector<std::int32_t> ascending(leaf.count), distances;
  std::iota(ascending.begin(), ascending.end(), 0);
  for (const DescriptorTree::Visit& visit : visits) {
    tree_->measure_rows(queries, static_cast<std::size_t>(visit.query), rows.data(), ascending, distances);
    for (std::size_t i = 0; i < leaf.count; ++i)
      if (distances[i] <= limit && landmarks[i] < landmarks_)
        found[static_cast<std::size_t>(visit.query)].push_back({landmarks[i], distances[i]});
  }
}

void PlaceFile::fetch_leaf(std::int32_t leaf) const {
  const LeafRows rows = rows_of(leaf);
  file_.fetch(layout_.rows + rows.first * kind_.stride(), rows.count * kind_.stride());
}

std::vector<PlaceFile::Neighbours> PlaceFile::find(const Descriptors& queries, double max_distance_share,
                                                   std::size_t leaves_per_descriptor) const {
  std::vector<Neighbours> found(queries.count());
  if (!tree_ || queries.count() == 0 || header_.rows == 0) return found;
  require_comparable(queries, kind_);
  const double distance = max_distance_share * header_.unrelated_distance;
  const auto limit = static_cast<std::int32_t>(queries.norm() == Norm::l2 ? distance * distance : distance);
  const std::vector<DescriptorTree::Visit> visits = tree_->find_leaves(queries, leaves_per_descriptor);
  for (std::size_t begin = 0, end = 0; begin < visits.size(); begin = end) {
    while (end < visits.size() && visits[end].leaf == visits[begin].leaf) ++end;
    if (end < visits.size()) fetch_leaf(visits[end].leaf);
    visit(std::span(visits).subspan(begin, end - begin), queries, limit, found);
  }
  for (Neighbours& of_query : found)
    std::sort(of_query.begin(), of_query.end(), [](const Neighbour& a, const Neighbour& b) {
      return a.distance != b.distance ? a.distance < b.distance : a.landmark < b.landmark;
    });
  return found;
}

std::span<const std::int32_t> PlaceFile::keyframes(std::uint64_t first_row, std::uint32_t count) const {
  require(first_row <= header_.observations && count <= header_.observations - first_row,
          "rows of Descriptor.bin are asked for");
  return file_.values<std::int32_t>(layout_.keyframes + 4 * first_row, count);
}

}  // namespace cairn
