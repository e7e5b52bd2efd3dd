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

/// Says in map.json that the file is one.
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

/// "hamming" or "l2".
[[nodiscard]] std::string_view to_string(Norm norm);

/// One keyframe in map.json.
struct KeyframeEntry {
  FrameId frame;  ///< position in its sequence; not valid where that is not known any more
  std::int64_t stamp_ns = 0;
  std::int32_t component = 0;
  std::uint32_t checksum = 0;  ///< that its file in frames/ ends with
};

/// Takes bytes and norm of descriptors from a file's header; InputError where they are not those of `kind`.
void get_descriptor_kind(const DescriptorKind& kind, BinaryReader& reader);

/// Contents of map.json: what the other files hold, and their checksums, by which files of two maps in one
/// folder are found out.
struct MapInfo : MapHeader {
  std::vector<KeyframeEntry> keyframes;
  std::uint32_t landmarks = 0;
  std::uint64_t features = 0;      ///< of all keyframes
  std::uint64_t observations = 0;  ///< of all landmarks
  /// By name, of the files beside map.json: of a text the CRC-32 of its bytes, of a binary file the checksum
  /// that it ends with.
  std::map<std::string, std::uint32_t> checksums;

  /// Nothing where map.json does not name the file.
  [[nodiscard]] std::optional<std::uint32_t> checksum_of(const std::string& name) const;
};

/// "frames/000007.orb": by the keyframe's number and the kind of its descriptors.
[[nodiscard]] std::string frame_file_name(KeyframeId number, const std::string& descriptor);

/// Whether cairn has descriptors of that name; case does not matter.
[[nodiscard]] bool is_known_descriptor(const std::string& name);

/// map.json in three pieces, so that it can be written while the keyframes pass by: what is before them (of
/// `info` all but keyframes and checksums), one keyframe, and what comes after them, without the seal.
[[nodiscard]] std::string format_map_info_begin(const MapInfo& info, std::size_t keyframes);
[[nodiscard]] std::string format_keyframe_entry(KeyframeId number, const KeyframeEntry& entry,
                                                const std::string& descriptor);
[[nodiscard]] std::string format_map_info_end(const MapInfo& info);
/// The seal: the last member of map.json, which is the CRC-32 of all before it.
[[nodiscard]] std::string format_map_info_seal(std::uint32_t checksum);

/// InputError where the file is missing, no JSON, of another version, damaged, lacks something, or
/// contradicts itself.
[[nodiscard]] MapInfo read_map_info(const std::filesystem::path& path);

}  // namespace cairn
