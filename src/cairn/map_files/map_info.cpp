// SPDX-License-Identifier: Apache-2.0
#include "cairn/map_files/map_info.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "cairn/core/text.h"
#include "cairn/features/extractor.h"

namespace cairn {
namespace {

using Json = nlohmann::ordered_json;

/// Writes a value on one line, with blanks after commas and colons. Replaces bytes that are not UTF-8. A line
/// break within a string is escaped, so that each that dump() writes stands between two values.
std::string on_one_line(const Json& json) {
  std::string text;
  for (const char c : json.dump(0, ' ', false, Json::error_handler_t::replace)) {
    if (c != '\n') text += c;
    if (c == '\n' && text.back() == ',') text += ' ';
  }
  return text;
}

/// Returns a number that is written without a point if it is whole.
Json number(double value) {
  constexpr double kLargest = 1e16;  // whole numbers from here on are written with an exponent
  if (std::trunc(value) == value && std::abs(value) < kLargest) return static_cast<std::int64_t>(value);
  return value;
}

Json to_json(const Rig& rig) {
  return {{"fx", number(rig.fx)},
          {"fy", number(rig.fy)},
          {"cx", number(rig.cx)},
          {"cy", number(rig.cy)},
          {"baseline", number(rig.baseline)}};
}

Json to_json(const StereoCorrection& correction) {
  Json rows = Json::array(), disparities = Json::array();
  for (const double term : correction.rows) rows.push_back(number(term));
  for (const double term : correction.disparity) disparities.push_back(number(term));
  return {{"rows_px", rows}, {"disparities_px", disparities}};
}

Json to_json(const GeodeticOrigin& origin) {
  return {{"latitude_deg", number(origin.latitude_deg)},
          {"longitude_deg", number(origin.longitude_deg)},
          {"height_m", number(origin.height_m)}};
}

Json to_json(const DisparityNoise& noise) {
  return {{"sigma_disparity_px", number(noise.sigma_px)}, {"sigma_depth_m", number(noise.sigma_m)}};
}

Json to_json(const DescriptorKind& kind) {
  return {{"name", kind.name}, {"norm", to_string(kind.norm)}, {"bytes", kind.bytes}};
}

/// Returns all members before the keyframes, in the order of the file.
Json header_members(const MapInfo& info, std::size_t keyframes) {
  Json members{{"format", kMapFormat}, {"version", kMapVersion}, {"frame", info.world}};
  if (info.origin) members["origin"] = to_json(*info.origin);
  members["rig"] = to_json(info.rig);
  if (info.right_correction) members["right_correction"] = to_json(*info.right_correction);
  if (info.depth_noise) members["depth_noise"] = to_json(*info.depth_noise);
  members["image"] = {{"width", info.width}, {"height", info.height}};
  members["descriptor"] = to_json(info.descriptor);
  members["settings"] = info.settings;
  members["counts"] = {{"keyframes", keyframes},
                       {"features", info.features},
                       {"landmarks", info.landmarks},
                       {"sightings", info.observations}};
  return members;
}

}  // namespace

std::string_view to_string(Norm norm) {
  return norm == Norm::hamming ? "hamming" : "l2";
}

void get_descriptor_kind(const DescriptorKind& kind, BinaryReader& reader) {
  const auto bytes = reader.get<std::uint32_t>(), norm = reader.get<std::uint32_t>();
  if (bytes != kind.bytes || norm != static_cast<std::uint32_t>(kind.norm))
    reader.fail(fmt::format("descriptors of {} bytes with norm {}, as map.json says", kind.bytes,
                            to_string(kind.norm)),
                fmt::format("{} bytes with norm number {}", bytes, norm));
}

std::optional<std::uint32_t> MapInfo::checksum_of(const std::string& name) const {
  const auto place = checksums.find(name);
  return place == checksums.end() ? std::nullopt : std::optional(place->second);
}

std::string frame_file_name(KeyframeId number, const std::string& descriptor) {
  return fmt::format("frames/{:06}.{}", number.value, lower_case(descriptor));
}

bool is_known_descriptor(const std::string& name) {
  return std::any_of(descriptor_names().begin(), descriptor_names().end(),
                     [&](const std::string& known) { return lower_case(known) == lower_case(name); });
}

std::string format_map_info_begin(const MapInfo& info, std::size_t keyframes) {
  const Json members = header_members(info, keyframes);
  std::string text = "{\n";
  for (const auto& [name, value] : members.items())
    text += fmt::format("  {}: {},\n", on_one_line(name), on_one_line(value));
  return text + "  \"keyframes\": [";
}

std::string format_keyframe_entry(KeyframeId number, const KeyframeEntry& entry,
                                  const std::string& descriptor) {
  const Json json{{"file", frame_file_name(number, descriptor)},
                  {"frame", entry.frame.value},
                  {"stamp_ns", entry.stamp_ns},
                  {"part", entry.component},
                  {"crc32", entry.checksum}};
  return (number.value == 0 ? "\n    " : ",\n    ") + on_one_line(json);
}

std::string format_map_info_end(const MapInfo& info) {
  return fmt::format("\n  ],\n  \"files\": {},\n", on_one_line(info.checksums));
}

std::string format_map_info_seal(std::uint32_t checksum) {
  return fmt::format("  \"crc32\": {}\n}}\n", checksum);
}

}  // namespace cairn
