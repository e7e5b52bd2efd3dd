// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "cairn/map_files/map_info.h"
#include "cairn/map_files/mapped_file.h"

namespace cairn {

/// Magic and version of Place.bin.
constexpr BinaryKind kPlaceKind{"CAIRNPLC", kMapVersion};

/// Holds the numbers that Place.bin begins with.
struct PlaceHeader {
  std::uint32_t bytes = 0, norm = 0;  ///< size and norm of a descriptor
  std::uint32_t branching = 0, branches = 0, leaves = 0;
  std::uint64_t rows = 0, observations = 0;
  double unrelated_distance = 0;  ///< mean distance of descriptors of different landmarks
};

/// Holds the offsets of the sections of Place.bin, bytes; each is a multiple of 8.
struct PlaceLayout {
  std::uint64_t used = 0, children = 0, centres = 0, leaf_begins = 0, rows = 0, landmarks = 0, keyframes = 0;
  std::uint64_t end = 0;
};

/// Returns the beginning of Place.bin.
[[nodiscard]] BinaryWriter begin_place_file(const PlaceHeader& header);
/// Reads the numbers that Place.bin begins with.
[[nodiscard]] PlaceHeader get_place_header(const MappedFile& file);
/// Computes the offsets of the sections.
[[nodiscard]] PlaceLayout layout_of(const PlaceHeader& header);
/// Returns whether a file of `file_bytes` without its seal can begin with this header.
[[nodiscard]] bool is_possible(const PlaceHeader& header, std::uint64_t file_bytes);

}  // namespace cairn
