// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "cairn/map_files/binary_file.h"
#include "cairn/map_files/landmark_files.h"

namespace cairn {

/// Reads Point.bin of the map in `folder` landmark by landmark, in memory that does not grow with it. Throws
/// InputError if the file is missing, damaged, of another version, not the one announced by `info`, or holds
/// impossible values. `info` must outlive the stream.
class LandmarkStream {
 public:
  LandmarkStream(const std::filesystem::path& folder, const MapInfo& info);
  /// Returns the next landmark, in the order of their numbers, or nullopt after the last.
  [[nodiscard]] std::optional<StoredLandmark> next();

 private:
  const MapInfo& info_;
  BinaryReader reader_;
  std::uint32_t number_ = 0;     // of the next
  std::uint64_t first_row_ = 0;  // that it has to have
};

/// Reads Descriptor.bin of the map in `folder` row by row, that is, the observations landmark by landmark, in
/// memory that does not grow with it. Keyframes lie in their range. Throws InputError if the file is missing,
/// damaged, of another version, not the one announced by `info`, or holds impossible values. `info` must
/// outlive the stream.
class ObservationStream {
 public:
  /// Holds an observation and its descriptor.
  struct Row {
    ObservationRef observation;
    const char* descriptor;  ///< as many bytes as the kind has; valid until the next row
  };
  ObservationStream(const std::filesystem::path& folder, const MapInfo& info);
  /// Returns the next row, or nullopt after the last.
  [[nodiscard]] std::optional<Row> next();

 private:
  const MapInfo& info_;
  BinaryReader reader_;
  std::uint64_t row_ = 0;
};

}  // namespace cairn
