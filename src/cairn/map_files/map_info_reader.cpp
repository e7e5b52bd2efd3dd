// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>

#include "cairn/core/checksum.h"
#include "cairn/core/error.h"
#include "cairn/core/file.h"
#include "cairn/features/extractor.h"
#include "cairn/map_files/map_info.h"

namespace cairn {
namespace {

using Json = nlohmann::json;

/// Takes values out of map.json and says what is wrong with them.
class MapInfoReader {
 public:
  explicit MapInfoReader(const std::filesystem::path& path) : path_(path), text_(read_file(path)) {}

  MapInfo read() {
    const Json json = parse();
    check_format(json);
    check_seal();
    MapInfo info;
    read_header(json, info);
    read_keyframes(json, info);
    read_counts(member(json, "counts"), info);
    for (const auto& [name, checksum] : member(json, "files").items())
      info.checksums[name] = whole<std::uint32_t>(checksum, name);
    return info;
  }

 private:
  [[noreturn]] void fail(std::string expected, std::string found, int line = 0) const {
    throw InputError({path_.string(), line, std::move(expected), std::move(found), std::string(kMapRemedy)});
  }

  Json parse() const {
    try {
      return Json::parse(text_);
    } catch (const Json::parse_error& error) {
      const auto end = text_.begin() + static_cast<std::ptrdiff_t>(std::min(error.byte, text_.size()));
      fail("JSON", "something else", 1 + static_cast<int>(std::count(text_.begin(), end, '\n')));
    }
  }

  const Json& member(const Json& json, const std::string& name) const {
    if (!json.is_object() || !json.contains(name)) fail(fmt::format("'{}'", name), "nothing of that name");
    return json[name];
  }

  template <class Value>
  Value whole(const Json& json, const std::string& name) const {
    const auto low = std::numeric_limits<Value>::min();
    const auto high = std::numeric_limits<Value>::max();
    const bool fits = json.is_number_unsigned()
                          ? std::cmp_less_equal(json.get<std::uint64_t>(), high)
                          : json.is_number_integer() && std::cmp_greater_equal(json.get<std::int64_t>(), low);
    if (!fits)
      fail(fmt::format("a whole number from {} to {} for '{}'", low, high, name),
           json.dump(-1, ' ', false, Json::error_handler_t::replace));
    return json.get<Value>();
  }

  template <class Value>
  Value whole_member(const Json& json, const std::string& name) const {
    return whole<Value>(member(json, name), name);
  }

  std::string text_member(const Json& json, const std::string& name) const {
    const Json& value = member(json, name);
    if (!value.is_string()) fail(fmt::format("a text for '{}'", name), value.type_name());
    return value.get<std::string>();
  }

  double number_member(const Json& json, const std::string& name) const {
    const Json& value = member(json, name);
    if (!value.is_number() || !std::isfinite(value.get<double>()))
      fail(fmt::format("a number for '{}'", name), value.type_name());
    return value.get<double>();
  }

  void check_format(const Json& json) const {
    if (const std::string format = text_member(json, "format"); format != kMapFormat)
      fail(fmt::format("the format '{}'", kMapFormat), fmt::format("'{}'", format));
    if (const auto version = whole_member<std::uint32_t>(json, "version"); version != kMapVersion)
      throw InputError({path_.string(), 0, fmt::format("version {} of the format", kMapVersion),
                        fmt::format("version {}", version), std::string(kVersionRemedy)});
  }

  void check_seal() const {
    const std::string_view body = std::string_view(text_).substr(0, text_.rfind("  \"crc32\""));
    if (text_.substr(body.size()) != format_map_info_seal(crc32(body)))
      fail("contents that fit their CRC-32", "others: the file is damaged or was changed");
  }

  void read_header(const Json& json, MapHeader& header) const {
    header.world = text_member(json, "frame");
    if (json.contains("origin")) header.origin = read_origin(json["origin"]);
    header.rig = read_rig(member(json, "rig"));
    if (json.contains("right_correction"))
      header.right_correction = read_correction(json["right_correction"]);
    if (json.contains("depth_noise")) header.depth_noise = read_noise(json["depth_noise"]);
    const Json& image = member(json, "image");
    header.width = whole_member<std::int32_t>(image, "width");
    header.height = whole_member<std::int32_t>(image, "height");
    if (header.width < 0 || header.height < 0)
      fail("a width and height of 0 or more", fmt::format("{} and {}", header.width, header.height));
    header.descriptor = read_descriptor(member(json, "descriptor"));
    header.settings = text_member(json, "settings");
  }

  DisparityNoise read_noise(const Json& json) const {
    const DisparityNoise noise{number_member(json, "sigma_disparity_px"),
                               number_member(json, "sigma_depth_m")};
    if (!(noise.sigma_px > 0 && noise.sigma_m >= 0))
      fail("a 'sigma_disparity_px' above 0 and a 'sigma_depth_m' of 0 or more",
           fmt::format("{} and {}", noise.sigma_px, noise.sigma_m));
    return noise;
  }

  GeodeticOrigin read_origin(const Json& json) const {
    const GeodeticOrigin origin{number_member(json, "latitude_deg"), number_member(json, "longitude_deg"),
                                number_member(json, "height_m")};
    if (!(std::abs(origin.latitude_deg) <= 90 && std::abs(origin.longitude_deg) <= 180))
      fail("a latitude within 90 degrees and a longitude within 180",
           fmt::format("{} and {}", origin.latitude_deg, origin.longitude_deg));
    return origin;
  }

  template <class Vector>
  Vector read_terms(const Json& json, const std::string& name) const {
    const Json& terms = member(json, name);
    Vector vector;
    const auto fits = [](const Json& term) { return term.is_number() && std::isfinite(term.get<double>()); };
    if (!terms.is_array() || std::ssize(terms) != vector.size() ||
        !std::all_of(terms.begin(), terms.end(), fits))
      fail(fmt::format("a list of {} numbers for '{}'", vector.size(), name),
           terms.dump(-1, ' ', false, Json::error_handler_t::replace));
    for (Eigen::Index i = 0; i < vector.size(); ++i)
      vector[i] = terms[static_cast<std::size_t>(i)].template get<double>();
    return vector;
  }

  StereoCorrection read_correction(const Json& json) const {
    return {read_terms<RowField>(json, "rows_px"), read_terms<DisparityField>(json, "disparities_px")};
  }

  Rig read_rig(const Json& json) const {
    const Rig rig{number_member(json, "fx"), number_member(json, "fy"), number_member(json, "cx"),
                  number_member(json, "cy"), number_member(json, "baseline")};
    if (!(rig.fx > 0 && rig.fy > 0 && rig.baseline > 0))
      fail("fx, fy and baseline above 0", fmt::format("{}, {} and {}", rig.fx, rig.fy, rig.baseline));
    return rig;
  }

  DescriptorKind read_descriptor(const Json& json) const {
    DescriptorKind kind{text_member(json, "name"), Norm::hamming, whole_member<std::uint32_t>(json, "bytes")};
    if (!is_known_descriptor(kind.name))
      fail(fmt::format("one of the descriptors {}", fmt::join(descriptor_names(), ", ")),
           fmt::format("'{}'", kind.name));
    const std::string norm = text_member(json, "norm");
    if (norm == to_string(Norm::l2)) kind.norm = Norm::l2;
    if (norm != to_string(kind.norm)) fail("the norm 'hamming' or 'l2'", fmt::format("'{}'", norm));
    return kind;
  }

  void read_keyframes(const Json& json, MapInfo& info) const {
    const Json& entries = member(json, "keyframes");
    if (!entries.is_array() || entries.empty()) fail("a list of keyframes", "none");
    for (const Json& entry : entries) {
      const KeyframeId number{static_cast<std::int32_t>(info.keyframes.size())};
      if (const auto name = frame_file_name(number, info.descriptor.name); text_member(entry, "file") != name)
        fail(fmt::format("the file {} for keyframe {}", name, number.value),
             fmt::format("'{}'", text_member(entry, "file")));
      info.keyframes.push_back(read_keyframe(entry));
    }
  }

  KeyframeEntry read_keyframe(const Json& json) const {
    const KeyframeEntry entry{{whole_member<std::int32_t>(json, "frame")},
                              whole_member<std::int64_t>(json, "stamp_ns"),
                              whole_member<std::int32_t>(json, "part"),
                              whole_member<std::uint32_t>(json, "crc32")};
    if (entry.component < 0) fail("parts from 0 up", fmt::format("{}", entry.component));
    return entry;
  }

  void read_counts(const Json& json, MapInfo& info) const {
    if (const auto count = whole_member<std::uint64_t>(json, "keyframes"); count != info.keyframes.size())
      fail(fmt::format("{} keyframes, as counted", count),
           fmt::format("a list of {}", info.keyframes.size()));
    info.landmarks = whole_member<std::uint32_t>(json, "landmarks");
    info.features = whole_member<std::uint64_t>(json, "features");
    info.observations = whole_member<std::uint64_t>(json, "sightings");
  }

  std::filesystem::path path_;
  std::string text_;
};

}  // namespace

MapInfo read_map_info(const std::filesystem::path& path) {
  return MapInfoReader(path).read();
}

}  // namespace cairn
