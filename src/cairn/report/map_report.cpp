// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/map_report.h"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>
#include <vector>

#include "cairn/report/json_pieces.h"
#include "cairn/report/ratio.h"
#include "cairn/report/text_builder.h"

namespace cairn {
namespace {

/// Names what is told of a distribution in JSON.
constexpr std::array<const char*, 6> kStatistics = {"min",           "percentile_5", "median",
                                                    "percentile_95", "max",          "mean"};
/// Returns what is told of a distribution, which is not empty.
std::array<double, 6> statistics_of(const Distribution& values) {
  return {values.min(),          values.quantile(0.05), values.quantile(0.5),
          values.quantile(0.95), values.max(),          values.mean()};
}

std::vector<std::size_t> component_sizes(const MapStatistics& figures) {
  std::vector<std::size_t> sizes;
  for (const auto& [component, size] : figures.component_keyframes) sizes.push_back(size);
  return sizes;
}

void add_counts(const MapStatistics& figures, TextBuilder& text) {
  const MapInfo& info = figures.info;
  text.add("keyframes    {}, {:.0f} features each\n", info.keyframes.size(),
           ratio(info.features, info.keyframes.size()));
  text.add("components   {}", figures.component_keyframes.size());
  if (figures.component_keyframes.size() > 1)
    text.add(", of {} keyframes", fmt::join(component_sizes(figures), ", "));
  text.add("\nlandmarks    {}\n", info.landmarks);
  text.add("observations {}, {:.2f} per landmark, {} at most\n", info.observations,
           ratio(info.observations, info.landmarks), figures.most_observations);
}

void add_header(const MapInfo& info, TextBuilder& text) {
  const Rig& rig = info.rig;
  text.add("descriptors  {} ({}, {} bytes)\n", info.descriptor.name,
           info.descriptor.norm == Norm::hamming ? "Hamming" : "L2", info.descriptor.bytes);
  text.add("camera       fx {:.7g} fy {:.7g} cx {:.7g} cy {:.7g} px, baseline {:.6g} m\n", rig.fx, rig.fy,
           rig.cx, rig.cy, rig.baseline);
  if (info.width > 0) text.add("images       {} x {} pixels\n", info.width, info.height);
  text.add("world        {}\n", info.world);
  if (info.origin)
    text.add("origin       latitude {:.9f}, longitude {:.9f} degrees, height {:.3f} m (WGS 84)\n",
             info.origin->latitude_deg, info.origin->longitude_deg, info.origin->height_m);
}

/// Adds a row for each indicator; metres if its name does not say otherwise.
void add_indicators(const MapStatistics& figures, TextBuilder& text) {
  if (figures.info.landmarks == 0) return;
  text.add("\n{:<16}{:>10}{:>10}{:>10}{:>10}{:>10}{:>10}\n", "indicator", "min", "5 %", "median", "95 %",
           "max", "mean");
  for (const auto& [name, values] : figures.indicators) {
    if (values.count() == 0) continue;
    text.add("{:<16}", name);
    for (const double value : statistics_of(values)) text.add("{:>10.4g}", value);
    text.add("\n");
  }
  text.add(
      "std_x, std_y, std_z and largest_std know the noise of observations and the stated errors of poses;\n"
      "errors that landmarks have in common and no pose states, as of a calibration, are not in them\n");
  if (figures.without_covariance > 0)
    text.add("no covariance: {} landmarks, of which no standard deviation is counted\n",
             figures.without_covariance);
}

Json indicators_json(const MapStatistics& figures) {
  Json json = Json::object();
  for (const auto& [name, values] : figures.indicators) {
    json[name]["count"] = values.count();
    if (values.count() == 0) continue;
    const auto statistics = statistics_of(values);
    for (std::size_t i = 0; i < statistics.size(); ++i) json[name][kStatistics[i]] = statistics[i];
  }
  return json;
}

}  // namespace

std::string format_map_json(const std::filesystem::path& folder, const MapStatistics& figures) {
  const MapInfo& info = figures.info;
  Json json;
  json["map"] = folder.string();
  json["keyframes"] = info.keyframes.size();
  json["features"] = info.features;
  json["parts"] = component_sizes(figures);
  json["landmarks"] = info.landmarks;
  json["sightings"] = info.observations;
  json["sightings_per_landmark"] = ratio(info.observations, info.landmarks);
  json["most_sightings"] = figures.most_observations;
  json["descriptor"] = info.descriptor.name;
  json["camera"] = {{"fx", info.rig.fx}, {"fy", info.rig.fy}, {"cx", info.rig.cx}, {"cy", info.rig.cy}};
  json["baseline_m"] = info.rig.baseline;
  json["image"] = {{"width", info.width}, {"height", info.height}};
  json["world"] = info.world;
  json["origin"] = info.origin ? Json{{"latitude_deg", info.origin->latitude_deg},
                                      {"longitude_deg", info.origin->longitude_deg},
                                      {"height_m", info.origin->height_m}}
                               : Json();
  json["without_covariance"] = figures.without_covariance;
  json["indicators"] = indicators_json(figures);
  return format_document(json);
}

std::string format_map_text(const std::filesystem::path& folder, const MapStatistics& figures) {
  TextBuilder text;
  text.add("map          {}\n", folder.string());
  add_counts(figures, text);
  add_header(figures.info, text);
  add_indicators(figures, text);
  return text.take();
}

}  // namespace cairn
