// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/fusion_report.h"

#include <gtest/gtest.h>

namespace cairn {
namespace {

CloudReport small_cloud() {
  CloudReport report;
  report.output = "room.ply";
  report.fusion = {10, 7, 2, 1, 0, false};
  report.points = 1234;
  report.voxel_m = 0.02;
  report.bounds = {{-1, 0, 0.5F}, {1, 3, 1}};
  report.bytes = 23'456;
  report.seconds = 1.25;
  return report;
}

TEST(CloudReport, tells_frames_points_and_extent) {
  EXPECT_EQ(format_cloud_text(small_cloud()),
            R"(frames       7 of 10 fused, 2 without pose, 1 without depth
points       1234, one per 0.02 m
box          2.00 x 3.00 x 0.50 m
file         room.ply, 23.5 kB
seconds      1.25
)");
}

TEST(CloudReport, names_the_picture_if_there_is_one) {
  CloudReport report = small_cloud();
  EXPECT_EQ(format_cloud_json(report).find("picture"), std::string::npos);
  report.picture = "room.png";
  EXPECT_NE(format_cloud_text(report).find("\npicture      room.png\n"), std::string::npos);
  EXPECT_NE(format_cloud_json(report).find(",\n  \"seconds\": 1.25,\n  \"picture\": \"room.png\"\n}\n"),
            std::string::npos);
}

TEST(CloudReport, has_in_json_what_the_text_has) {
  CloudReport report = small_cloud();
  report.fusion.stopped = true;
  EXPECT_EQ(format_cloud_json(report), R"({
  "output": "room.ply",
  "frames": {
    "total": 10,
    "fused": 7,
    "without_pose": 2,
    "without_depth": 1,
    "unreadable": 0,
    "stopped": true
  },
  "points": 1234,
  "voxel_m": 0.02,
  "box_low_m": [
    -1.0,
    0.0,
    0.5
  ],
  "box_high_m": [
    1.0,
    3.0,
    1.0
  ],
  "bytes": 23456,
  "seconds": 1.25
}
)");
}

OctreeReport small_octree() {
  OctreeReport report;
  report.output = "room.bt";
  report.points = 50;
  report.resolution_m = 0.05;
  report.file = {12, 345};
  report.counts.occupied = 8;
  report.counts.free = 9;
  report.seconds = 0.5;
  return report;
}

TEST(OctreeReport, tells_points_of_a_cloud) {
  EXPECT_EQ(
      format_octree_text(small_octree()),
      "points       50\nvoxels       8 occupied, 9 free, of 0.05 m\nfile         room.bt, 345 bytes, 12 "
      "nodes: occupied and free\nseconds      0.50\n");
  EXPECT_EQ(format_octree_json(small_octree()), R"({
  "output": "room.bt",
  "points": 50,
  "resolution_m": 0.05,
  "occupied": 8,
  "free": 9,
  "nodes": 12,
  "contents": "occupied and free",
  "bytes": 345,
  "seconds": 0.5
}
)");
}

TEST(OctreeReport, tells_frames_of_a_sequence) {
  OctreeReport report = small_octree();
  report.fusion = FusionReport{3, 2, 0, 0, 1, true};
  EXPECT_EQ(format_octree_text(report).find("frames       2 of 3 fused, 1 unreadable, stopped by the user\n"),
            0U);
  EXPECT_EQ(format_octree_json(report).find("points"), std::string::npos);
}

TEST(FormatBytes, chooses_the_unit) {
  EXPECT_EQ(format_bytes(999), "999 bytes");
  EXPECT_EQ(format_bytes(1500), "1.5 kB");
  EXPECT_EQ(format_bytes(2'340'000), "2.3 MB");
}

}  // namespace
}  // namespace cairn
