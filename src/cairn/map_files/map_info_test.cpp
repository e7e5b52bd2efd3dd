// SPDX-License-Identifier: Apache-2.0
#include "cairn/map_files/map_info.h"

#include <gtest/gtest.h>

#include <string>

#include "cairn/core/checksum.h"
#include "cairn/testing/core/temporary_folder.h"

namespace cairn {
namespace {

MapInfo small_info() {
  MapInfo info;
  info.rig = {525, 1.0 / 3, -0.1, 1.7976931348623157e308, 1e-7};
  info.width = 640;
  info.height = 480;
  info.descriptor = {"ORB", Norm::hamming, 32};
  info.keyframes = {{{-1}, 1'205'031'453'359'684'000, 0, 4'294'967'295}};
  info.landmarks = 1;
  info.features = 5'000'000'000;
  info.observations = 2;
  info.checksums = {{"Point.bin", 7}, {"poses.txt", 0}};
  return info;
}

/// Returns map.json as MapWriter writes it.
std::string format(const MapInfo& info) {
  std::string text = format_map_info_begin(info, info.keyframes.size());
  KeyframeId number{0};
  for (const KeyframeEntry& entry : info.keyframes) {
    text += format_keyframe_entry(number, entry, info.descriptor.name);
    ++number.value;
  }
  text += format_map_info_end(info);
  return text + format_map_info_seal(crc32(text));
}

MapInfo written_and_read(const MapInfo& info) {
  const testkit::TemporaryFolder folder;
  write_file(folder.path() / kMapInfoFile, format(info));
  return read_map_info(folder.path() / kMapInfoFile);
}

TEST(MapInfo, has_one_member_a_line) {
  const std::string text = format(small_info());
  EXPECT_EQ(text.substr(0, text.rfind("  \"crc32\"")),
            R"({
  "format": "cairn keyframe map",
  "version": 3,
  "frame": "camera of the first keyframe",
  "rig": {"fx": 525, "fy": 0.3333333333333333, "cx": -0.1, "cy": 1.7976931348623157e+308, "baseline": 1e-07},
  "image": {"width": 640, "height": 480},
  "descriptor": {"name": "ORB", "norm": "hamming", "bytes": 32},
  "settings": "",
  "counts": {"keyframes": 1, "features": 5000000000, "landmarks": 1, "sightings": 2},
  "keyframes": [
    {"file": "frames/000000.orb", "frame": -1, "stamp_ns": 1205031453359684000, "part": 0, "crc32": 4294967295}
  ],
  "files": {"Point.bin": 7, "poses.txt": 0},
)");
}

TEST(MapInfo, is_read_as_it_was_written) {
  MapInfo info = small_info();
  info.rig.cy = 1e16;  // the first whole number with an exponent
  info.origin = GeodeticOrigin{49.011212804408, 8.4228850437969, -112.83};
  info.keyframes.push_back({{9}, -1, 2'147'483'647, 0});
  const MapInfo read = written_and_read(info);
  for (const auto intrinsic : {&Rig::fx, &Rig::fy, &Rig::cx, &Rig::cy, &Rig::baseline})
    EXPECT_EQ(read.rig.*intrinsic, info.rig.*intrinsic);
  ASSERT_TRUE(read.origin);
  EXPECT_EQ(read.origin->latitude_deg, info.origin->latitude_deg);
  EXPECT_EQ(read.origin->longitude_deg, info.origin->longitude_deg);
  EXPECT_EQ(read.origin->height_m, info.origin->height_m);
  EXPECT_EQ(read.features, info.features);
  EXPECT_EQ(read.checksums, info.checksums);
  ASSERT_EQ(read.keyframes.size(), 2U);
  EXPECT_EQ(read.keyframes[0].stamp_ns, info.keyframes[0].stamp_ns);
  EXPECT_EQ(read.keyframes[0].checksum, info.keyframes[0].checksum);
  EXPECT_EQ(read.keyframes[1].frame, FrameId{9});
  EXPECT_EQ(read.keyframes[1].component, info.keyframes[1].component);
}

TEST(MapInfo, keeps_what_was_taken_off_a_pair) {
  MapInfo info = small_info();
  EXPECT_FALSE(written_and_read(info).right_correction);
  StereoCorrection& correction = info.right_correction.emplace();
  correction.rows << -0.25, 1.0 / 3, 0, -7.3, 1e-9, 2;
  correction.disparity = {-0.76, 0.1, -1.8};
  const MapInfo read = written_and_read(info);
  ASSERT_TRUE(read.right_correction);
  EXPECT_EQ(read.right_correction->rows, correction.rows);
  EXPECT_EQ(read.right_correction->disparity, correction.disparity);
}

TEST(MapInfo, keeps_the_noise_of_depth) {
  MapInfo info = small_info();
  EXPECT_FALSE(written_and_read(info).depth_noise);
  info.depth_noise = DisparityNoise{1.0 / 3, 0.0012};
  const MapInfo read = written_and_read(info);
  ASSERT_TRUE(read.depth_noise);
  EXPECT_EQ(read.depth_noise->sigma_px, 1.0 / 3);
  EXPECT_EQ(read.depth_noise->sigma_m, 0.0012);
}

TEST(MapInfo, holds_any_text) {
  MapInfo info = small_info();
  info.world = "a \"quote\", a \\ and a line,\nits break\t\x01 and \xC3\xA9";
  info.settings = ",\n, {\n}\n  \"crc32\": 5\n";
  const MapInfo read = written_and_read(info);
  EXPECT_EQ(read.world, info.world);
  EXPECT_EQ(read.settings, info.settings);
}

TEST(MapInfo, replaces_bytes_that_are_not_utf8) {
  MapInfo info = small_info();
  info.settings = "sequence: caf\xE9";
  EXPECT_EQ(written_and_read(info).settings, "sequence: caf\xEF\xBF\xBD");
}

}  // namespace
}  // namespace cairn
