// SPDX-License-Identifier: Apache-2.0
#include "cairn/map_files/place_layout.h"

#include <cmath>

namespace cairn {
namespace {

constexpr std::uint64_t kHeaderBytes = 56;

std::uint64_t padded(std::uint64_t bytes) {
  return (bytes + 7) / 8 * 8;
}

}  // namespace

BinaryWriter begin_place_file(const PlaceHeader& header) {
  BinaryWriter writer(kPlaceKind);
  for (const std::uint32_t value :
       {header.bytes, header.norm, header.branching, header.branches, header.leaves})
    writer.put(value);
  writer.put(header.rows);
  writer.put(header.observations);
  writer.put(header.unrelated_distance);
  return writer;
}

PlaceHeader get_place_header(const MappedFile& file) {
  PlaceHeader header;
  std::uint64_t place = 12;
  for (std::uint32_t* value :
       {&header.bytes, &header.norm, &header.branching, &header.branches, &header.leaves}) {
    *value = file.at<std::uint32_t>(place);
    place += sizeof *value;
  }
  header.rows = file.at<std::uint64_t>(place);
  header.observations = file.at<std::uint64_t>(place + 8);
  header.unrelated_distance = file.at<double>(place + 16);
  return header;
}

PlaceLayout layout_of(const PlaceHeader& header) {
  const std::uint64_t places = std::uint64_t{header.branches} * header.branching;
  const std::uint64_t stride = padded(header.bytes);
  PlaceLayout layout;
  layout.used = kHeaderBytes;
  layout.children = layout.used + padded(4 * std::uint64_t{header.branches});
  layout.centres = layout.children + padded(4 * places);
  layout.leaf_begins = layout.centres + stride * places;
  layout.rows = layout.leaf_begins + 8 * (std::uint64_t{header.leaves} + 1);
  layout.landmarks = layout.rows + stride * header.rows;
  layout.keyframes = layout.landmarks + padded(4 * header.rows);
  layout.end = layout.keyframes + padded(4 * header.observations);
  return layout;
}

bool is_possible(const PlaceHeader& header, std::uint64_t file_bytes) {
  constexpr std::uint32_t kMostBranching = 1024, kMostBytes = 32768;
  // None of these can exceed the size of the file, so no product below overflows.
  return header.branching >= 2 && header.branching <= kMostBranching && header.bytes <= kMostBytes &&
         header.branches <= file_bytes && header.leaves >= 1 && header.leaves <= file_bytes &&
         header.rows <= file_bytes && header.observations <= file_bytes && file_bytes < (1ULL << 47U) &&
         std::isfinite(header.unrelated_distance) && header.unrelated_distance >= 0 &&
         layout_of(header).end == file_bytes;
}

}  // namespace cairn
