// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/fusion_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cairn/report/json_pieces.h"
#include "cairn/report/text_builder.h"

namespace cairn {
namespace {

void add_fusion(const FusionReport& report, TextBuilder& text) {
  text.add("frames       {} of {} fused", report.fused, report.frames);
  if (report.without_pose > 0) text.add(", {} without pose", report.without_pose);
  if (report.without_depth > 0) text.add(", {} without depth", report.without_depth);
  if (report.unreadable > 0) text.add(", {} unreadable", report.unreadable);
  text.add("{}\n", report.stopped ? ", stopped by the user" : "");
}

Json to_json(const FusionReport& report) {
  return {{"total", report.frames},
          {"fused", report.fused},
          {"without_pose", report.without_pose},
          {"without_depth", report.without_depth},
          {"unreadable", report.unreadable},
          {"stopped", report.stopped}};
}

Json to_json(const Eigen::Vector3f& corner) {
  return {corner.x(), corner.y(), corner.z()};
}

}  // namespace

std::string format_bytes(std::int64_t bytes) {
  if (bytes < 1000) return fmt::format("{} bytes", bytes);
  if (bytes < 1'000'000) return fmt::format("{:.1f} kB", 1e-3 * static_cast<double>(bytes));
  return fmt::format("{:.1f} MB", 1e-6 * static_cast<double>(bytes));
}

std::string format_cloud_text(const CloudReport& report) {
  const Eigen::Vector3f size = report.bounds.high - report.bounds.low;
  TextBuilder text;
  add_fusion(report.fusion, text);
  text.add("points       {}, one per {} m\n", report.points, report.voxel_m);
  text.add("box          {:.2f} x {:.2f} x {:.2f} m\n", size.x(), size.y(), size.z());
  text.add("file         {}, {}\n", report.output, format_bytes(report.bytes));
  if (!report.picture.empty()) text.add("picture      {}\n", report.picture);
  text.add("seconds      {:.2f}\n", report.seconds);
  return text.take();
}

std::string format_cloud_json(const CloudReport& report) {
  Json json = {{"output", report.output},
               {"frames", to_json(report.fusion)},
               {"points", report.points},
               {"voxel_m", report.voxel_m},
               {"box_low_m", to_json(report.bounds.low)},
               {"box_high_m", to_json(report.bounds.high)},
               {"bytes", report.bytes},
               {"seconds", report.seconds}};
  if (!report.picture.empty()) json["picture"] = report.picture;
  return format_document(json);
}

std::string format_octree_text(const OctreeReport& report) {
  TextBuilder text;
  if (report.fusion) {
    add_fusion(*report.fusion, text);
  } else {
    text.add("points       {}\n", report.points);
  }
  text.add("voxels       {} occupied, {} free, of {} m\n", report.counts.occupied, report.counts.free,
           report.resolution_m);
  text.add("file         {}, {}, {} nodes: {}\n", report.output, format_bytes(report.file.bytes),
           report.file.nodes, to_string(report.contents));
  text.add("seconds      {:.2f}\n", report.seconds);
  return text.take();
}

std::string format_octree_json(const OctreeReport& report) {
  Json json;
  json["output"] = report.output;
  if (report.fusion) {
    json["frames"] = to_json(*report.fusion);
  } else {
    json["points"] = report.points;
  }
  json["resolution_m"] = report.resolution_m;
  json["occupied"] = report.counts.occupied;
  json["free"] = report.counts.free;
  json["nodes"] = report.file.nodes;
  json["contents"] = to_string(report.contents);
  json["bytes"] = report.file.bytes;
  json["seconds"] = report.seconds;
  return format_document(json);
}

}  // namespace cairn
