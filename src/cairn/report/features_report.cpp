// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/features_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cairn/report/json_pieces.h"
#include "cairn/report/text_builder.h"

namespace cairn {
namespace {

Json to_json(const FeatureCounts& image) {
  return {{"image", image.path},
          {"width", image.width},
          {"height", image.height},
          {"keypoints", image.keypoints},
          {"descriptor_bytes", image.descriptor_bytes},
          {"time_ms", image.time_ms}};
}

Json matched_json(const TimedFeatures& image) {
  return {{"image", image.path}, {"keypoints", image.features.keypoints.size()}, {"time_ms", image.time_ms}};
}

}  // namespace

FeatureCounts counts_of(const TimedFeatures& timed) {
  return {timed.path,
          timed.image.width(),
          timed.image.height(),
          timed.features.keypoints.size(),
          timed.features.descriptors.bytes(),
          timed.time_ms};
}

std::string format_features_json(const std::string& method, std::span<const FeatureCounts> images,
                                 std::int64_t unreadable) {
  Json list = Json::array();
  for (const FeatureCounts& image : images) list.push_back(to_json(image));
  return format_document({{"method", method}, {"images", list}, {"unreadable", unreadable}});
}

std::string format_features_text(std::span<const FeatureCounts> images, std::int64_t unreadable) {
  TextBuilder text;
  for (const FeatureCounts& image : images)
    text.add("{}  {}x{}  {} keypoints  {:.3f} ms\n", image.path, image.width, image.height, image.keypoints,
             image.time_ms);
  if (unreadable > 0) text.add("{} images cannot be read and were skipped\n", unreadable);
  return text.take();
}

std::string format_keypoints_csv(std::span<const Keypoint> keypoints) {
  TextBuilder csv;
  csv.add("u,v,size,angle_deg,response\n");
  for (const Keypoint& k : keypoints) csv.add("{},{},{},{},{}\n", k.u, k.v, k.size, k.angle_deg, k.response);
  return csv.take();
}

std::string format_match_json(const MatchReport& report) {
  Json json;
  json["method"] = report.method;
  json["images"] = Json::array({matched_json(report.a), matched_json(report.b)});
  json["matches"] = report.matches.size();
  json["matching_time_ms"] = report.time_ms;
  return format_document(json);
}

std::string format_match_text(const MatchReport& report) {
  TextBuilder text;
  for (const TimedFeatures* image : {&report.a, &report.b})
    text.add("{}  {} keypoints  {:.3f} ms\n", image->path, image->features.keypoints.size(), image->time_ms);
  text.add("{} matches  {:.3f} ms\n", report.matches.size(), report.time_ms);
  return text.take();
}

std::string format_matches_csv(const MatchReport& report) {
  TextBuilder csv;
  csv.add("u1,v1,u2,v2,distance\n");
  for (const Match& match : report.matches) {
    const Keypoint& from = report.a.features.keypoints[static_cast<std::size_t>(match.query)];
    const Keypoint& to = report.b.features.keypoints[static_cast<std::size_t>(match.train)];
    csv.add("{},{},{},{},{}\n", from.u, from.v, to.u, to.v, match.distance);
  }
  return csv.take();
}

}  // namespace cairn
