// SPDX-License-Identifier: Apache-2.0
#include "info_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cairn/map/map_file.h"

namespace cairn::app {
namespace {

struct MapFigures {
  std::size_t keyframes = 0, features = 0, landmarks = 0, sightings = 0;
  std::size_t most_sightings = 0;                      ///< of one landmark
  std::map<std::int32_t, std::size_t> part_keyframes;  ///< by part
};

MapFigures count(const cairn::Map& map) {
  MapFigures figures;
  figures.keyframes = map.keyframes().size();
  figures.landmarks = map.landmarks().size();
  for (const Keyframe& keyframe : map.keyframes()) {
    figures.features += keyframe.observed.observations.size();
    ++figures.part_keyframes[keyframe.part];
  }
  for (const Landmark& landmark : map.landmarks()) {
    figures.sightings += landmark.sightings.size();
    figures.most_sightings = std::max(figures.most_sightings, landmark.sightings.size());
  }
  return figures;
}

double ratio(std::size_t a, std::size_t b) {
  return b > 0 ? static_cast<double>(a) / static_cast<double>(b) : 0.0;
}

/// "hamming, 32 bytes"; where no keyframe has a feature, the bytes are 0.
std::string describe_descriptors(const cairn::Map& map) {
  const Descriptors& descriptors = map.keyframes().front().observed.features.descriptors;
  return fmt::format("{} ({}, {} bytes)", map.descriptor(),
                     descriptors.norm() == Norm::hamming ? "Hamming" : "L2", descriptors.bytes());
}

void print_text(const std::filesystem::path& folder, const cairn::Map& map, const MapFigures& figures) {
  const Rig& rig = map.rig();
  fmt::print("map          {}\n", folder.string());
  fmt::print("keyframes    {}, {:.0f} features each\n", figures.keyframes,
             ratio(figures.features, figures.keyframes));
  fmt::print("parts        {}", figures.part_keyframes.size());
  if (figures.part_keyframes.size() > 1) {
    std::vector<std::size_t> sizes;
    for (const auto& [part, size] : figures.part_keyframes) sizes.push_back(size);
    fmt::print(", of {} keyframes", fmt::join(sizes, ", "));
  }
  fmt::print("\nlandmarks    {}\n", figures.landmarks);
  fmt::print("sightings    {}, {:.2f} per landmark, {} at most\n", figures.sightings,
             ratio(figures.sightings, figures.landmarks), figures.most_sightings);
  fmt::print("descriptors  {}\n", describe_descriptors(map));
  fmt::print("camera       fx {:.7g} fy {:.7g} cx {:.7g} cy {:.7g} px, baseline {:.6g} m\n", rig.fx, rig.fy,
             rig.cx, rig.cy, rig.baseline);
}

void print_json(const std::filesystem::path& folder, const cairn::Map& map, const MapFigures& figures) {
  const Rig& rig = map.rig();
  nlohmann::ordered_json json;
  json["map"] = folder.string();
  json["keyframes"] = figures.keyframes;
  json["features"] = figures.features;
  json["parts"] = nlohmann::ordered_json::array();
  for (const auto& [part, size] : figures.part_keyframes) json["parts"].push_back(size);
  json["landmarks"] = figures.landmarks;
  json["sightings"] = figures.sightings;
  json["sightings_per_landmark"] = ratio(figures.sightings, figures.landmarks);
  json["descriptor"] = map.descriptor();
  json["camera"] = {{"fx", rig.fx}, {"fy", rig.fy}, {"cx", rig.cx}, {"cy", rig.cy}};
  json["baseline_m"] = rig.baseline;
  fmt::print("{}\n", json.dump(2));
}

}  // namespace

void print_map_info(const std::filesystem::path& folder, bool json) {
  const cairn::Map map = read_map(folder);
  json ? print_json(folder, map, count(map)) : print_text(folder, map, count(map));
}

}  // namespace cairn::app
