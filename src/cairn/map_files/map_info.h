// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cairn/core/id.h"
#include "cairn/map/map_header.h"
#include "cairn/map_files/binary_file.h"

namespace cairn {

/// Value of "format" in map.json.
constexpr std::string_view kMapFormat = "cairn keyframe map";

/// Version of the layout of all files of a map.
constexpr std::uint32_t kMapVersion = 3;

/// Names of files in the folder of a map, see docs/map_format.md.
constexpr const char* kMapInfoFile = "map.json";
constexpr const char* kPosesFile = "poses.txt";
constexpr const char* kUvlistFile = "uvlist.txt";
constexpr const char* kPointFile = "Point.bin";
constexpr const char* kDescriptorFile = "Descriptor.bin";
constexpr const char* kPlaceFile = "Place.bin";
constexpr const char* kHeldOutFile = "held_out.txt";  ///< not in every map
constexpr const char* kNoiseFile = "Noise.bin";       ///< not in every map

/// Returns "hamming" or "l2".
[[nodiscard]] std::string_view to_string(Norm norm);

/// Holds the entry of a keyframe in map.json.
struct KeyframeEntry {
  FrameId frame;  ///< position in its sequence; not valid if that is no longer known
  std::int64_t stamp_ns = 0;
  std::int32_t component = 0;
  std::uint32_t checksum = 0;  ///< checksum that its file in frames/ ends with
};

/// Reads size and norm of descriptors from a file's header. Throws InputError if they are not those of
/// `kind`.
void get_descriptor_kind(const DescriptorKind& kind, BinaryReader& reader);

/// Holds the contents of map.json: what the other files hold, and their checksums, which show if files of two
/// maps are mixed in a folder.
struct MapInfo : MapHeader {
  std::vector<KeyframeEntry> keyframes;
  std::uint32_t landmarks = 0;
  std::uint64_t features = 0;      ///< of all keyframes
  std::uint64_t observations = 0;  ///< of all landmarks
  /// Checksums of the files beside map.json by name: of a text the CRC-32 of its bytes, of a binary file the
  /// checksum that it ends with.
  std::map<std::string, std::uint32_t> checksums;

  /// Returns the checksum of a file, or nullopt if map.json does not name it.
  [[nodiscard]] std::optional<std::uint32_t> checksum_of(const std::string& name) const;
};

/// Returns the name of a keyframe's file, by its number and the kind of its descriptors: "frames/000007.orb".
[[nodiscard]] std::string frame_file_name(KeyframeId number, const std::string& descriptor);

/// Returns whether cairn has descriptors of that name; case does not matter.
[[nodiscard]] bool is_known_descriptor(const std::string& name);

/// Returns what comes before the keyframes in map.json: all of `info` but keyframes and checksums. It is
/// written in three pieces, while the keyframes pass by.
[[nodiscard]] std::string format_map_info_begin(const MapInfo& info, std::size_t keyframes);
/// Returns the entry of a keyframe in map.json, with the comma before it.
[[nodiscard]] std::string format_keyframe_entry(KeyframeId number, const KeyframeEntry& entry,
                                                const std::string& descriptor);
/// Returns what comes after the keyframes in map.json: the checksums of the files. The seal is still missing.
[[nodiscard]] std::string format_map_info_end(const MapInfo& info);
/// Returns the seal, the last member of map.json; `checksum` is the CRC-32 of all before it.
[[nodiscard]] std::string format_map_info_seal(std::uint32_t checksum);

/// Reads map.json. Throws InputError if it is missing, not JSON, of another version, damaged, incomplete, or
/// contradicts itself.
[[nodiscard]] MapInfo read_map_info(const std::filesystem::path& path);

}  // namespace cairn
