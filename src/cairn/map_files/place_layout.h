// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "cairn/map_files/map_info.h"
#include "cairn/map_files/mapped_file.h"

namespace cairn {

constexpr BinaryKind kPlaceKind{"CAIRNPLC", kMapVersion};

/// The numbers that Place.bin begins with.
struct PlaceHeader {
  std::uint32_t bytes = 0, norm = 0;  ///< of a descriptor
  std::uint32_t branching = 0, branches = 0, leaves = 0;
  std::uint64_t rows = 0, observations = 0;
  double unrelated_distance = 0;  ///< mean of descriptors of different landmarks
};

/// Where the sections of Place.bin begin, bytes; each at a multiple of 8.
struct PlaceLayout {
  std::uint64_t used = 0, children = 0, centres = 0, leaf_begins = 0, rows = 0, landmarks = 0, keyframes = 0;
  std::uint64_t end = 0;
};

[[nodiscard]] BinaryWriter begin_place_file(const PlaceHeader& header);
[[nodiscard]] PlaceHeader get_place_header(const MappedFile& file);
[[nodiscard]] PlaceLayout layout_of(const PlaceHeader& header);
/// Whether a file of so many bytes, without its seal, can begin so.
[[nodiscard]] bool is_possible(const PlaceHeader& header, std::uint64_t file_bytes);

}  // namespace cairn
