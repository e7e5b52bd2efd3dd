// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "cairn/map_files/binary_file.h"
#include "cairn/map_files/landmark_files.h"

namespace cairn {

/// Point.bin of the map in `folder`, as `info` announces it, landmark by landmark, in memory that does not
/// grow with it. InputError where the file is missing, damaged, of another version, not the one that was
/// announced, or holds impossible values. `info` outlives it.
class LandmarkStream {
 public:
  LandmarkStream(const std::filesystem::path& folder, const MapInfo& info);
  /// In the order of their numbers; nothing after the last.
  [[nodiscard]] std::optional<StoredLandmark> next();

 private:
  const MapInfo& info_;
  BinaryReader reader_;
  std::uint32_t number_ = 0;     // of the next
  std::uint64_t first_row_ = 0;  // that it has to have
};

/// The same for the rows of Descriptor.bin: the observations, landmark by landmark. Keyframes lie in their
/// range.
class ObservationStream {
 public:
  struct Row {
    ObservationRef observation;
    const char* descriptor;  ///< as many bytes as the kind has; valid until the next row
  };
  ObservationStream(const std::filesystem::path& folder, const MapInfo& info);
  [[nodiscard]] std::optional<Row> next();

 private:
  const MapInfo& info_;
  BinaryReader reader_;
  std::uint64_t row_ = 0;
};

}  // namespace cairn
