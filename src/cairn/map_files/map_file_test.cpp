// SPDX-License-Identifier: Apache-2.0
#include "cairn/map_files/map_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "cairn/core/checksum.h"
#include "cairn/core/error.h"
#include "cairn/core/file.h"
#include "cairn/testing/core/temporary_folder.h"
#include "cairn/testing/map_files/scene_map.h"

namespace cairn {
namespace {

using testkit::contents_of;
using testkit::kSceneRig;
using testkit::scene_map;
using testkit::TemporaryFolder;

template <class Value>
Value at(const std::string& bytes, std::size_t offset) {
  Value value;
  std::memcpy(&value, bytes.data() + offset, sizeof(Value));
  return value;
}

/// Keyframe 1 of two, whose second feature shows the only landmark, as the first's first does.
Map small_map() {
  Map map({525, 525, 319.5, 239.5, 0.075}, "ORB");
  for (int k = 0; k < 2; ++k) {
    ObservedFrame frame;
    frame.frame = {7 + k};
    frame.stamp_ns = 1'500'000'000 + k;
    frame.features.descriptors = Descriptors(Norm::hamming, 3, 2);
    for (std::uint8_t b = 0; b < 3; ++b) {
      frame.features.descriptors.row(0)[b] = b;
      frame.features.descriptors.row(1)[b] = static_cast<std::uint8_t>(16 + b);
    }
    frame.features.keypoints = {{1.5, 2.5, 31, 90, 0, 1.2F}, {3.5, 4.5}};
    frame.observations = {{1.5, 2.5, 10.0, 1.25, 0.5}, {3.5, 4.5}};
    frame.points_in_camera.resize(2);
    map.add_keyframe(std::move(frame), {Eigen::Quaterniond::Identity(), {0.0, 0.25, k * 1e-12}}, {k - 1}, 0);
  }
  const LandmarkId landmark = map.add_landmark({0.5, -1, 2}, {{0}, 0});
  map.add_observation(landmark, {{1}, 1});
  return map;
}

/// Of a file of one block.
void expect_seal(const std::string& bytes) {
  EXPECT_EQ(at<std::uint32_t>(bytes, bytes.size() - 8),
            crc32(std::string_view(bytes).substr(0, bytes.size() - 8)));
  EXPECT_EQ(at<std::uint32_t>(bytes, bytes.size() - 4),
            crc32(std::string_view(bytes).substr(bytes.size() - 8, 4)));
}

TEST(MapFile, frames_have_the_documented_layout) {
  const TemporaryFolder folder;
  write_map(folder.path(), small_map());
  const std::string bytes = read_file(folder.path() / "frames/000001.orb");
  constexpr std::size_t kHeader = 32, kRecord = 39;
  ASSERT_EQ(bytes.size(), kHeader + 2 * kRecord + 8);
  EXPECT_EQ(bytes.substr(0, 8), "CAIRNFRM");
  EXPECT_EQ(at<std::uint32_t>(bytes, 8), 3U);                    // version
  EXPECT_EQ(at<std::int32_t>(bytes, 12), 1);                     // keyframe
  EXPECT_EQ(at<std::int32_t>(bytes, 16), 8);                     // frame
  EXPECT_EQ(at<std::uint32_t>(bytes, 20), 2U);                   // features
  EXPECT_EQ(at<std::uint32_t>(bytes, 24), 3U);                   // bytes of a descriptor
  EXPECT_EQ(at<std::uint32_t>(bytes, 28), 0U);                   // Hamming
  EXPECT_EQ(at<std::uint32_t>(bytes, kHeader + kRecord), 1U);    // index
  EXPECT_EQ(at<std::int32_t>(bytes, kHeader + 4), -1);           // no landmark
  EXPECT_EQ(at<std::int32_t>(bytes, kHeader + kRecord + 4), 0);  // the landmark
  const float first[] = {1.5, 2.5, 10.0, 1.25, 0.5, 31, 90};     // u, v, d, their sigmas, size, angle
  for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(at<float>(bytes, kHeader + 8 + 4 * i), first[i]) << i;
  const auto disparity = at<float>(bytes, kHeader + kRecord + 16);
  EXPECT_NE(disparity, disparity);  // unknown: NaN
  EXPECT_EQ(bytes.substr(kHeader + kRecord + 36, 3), "\x10\x11\x12");
  expect_seal(bytes);
}

TEST(MapFile, points_have_the_documented_layout) {
  const TemporaryFolder folder;
  const Eigen::Matrix3d covariance = (Eigen::Matrix3d() << 9, 1, 2, 1, 4, 3, 2, 3, 8).finished();
  write_map(folder.path(), small_map(), std::vector{covariance});
  const std::string bytes = read_file(folder.path() / "Point.bin");
  ASSERT_EQ(bytes.size(), 24U + 112 + 8);
  EXPECT_EQ(bytes.substr(0, 8), "CAIRNPNT");
  EXPECT_EQ(at<std::uint32_t>(bytes, 8), 3U);   // version
  EXPECT_EQ(at<std::uint32_t>(bytes, 12), 1U);  // landmarks
  EXPECT_EQ(at<std::uint64_t>(bytes, 16), 2U);  // observations
  EXPECT_EQ(at<std::uint32_t>(bytes, 24), 0U);  // number
  EXPECT_EQ(at<std::uint32_t>(bytes, 28), 2U);  // its observations
  EXPECT_EQ(at<std::uint64_t>(bytes, 32), 0U);  // row of the first
  const double doubles[] = {0.5, -1, 2, 9, 1, 2, 1, 4, 3, 2, 3, 8};
  for (std::size_t i = 0; i < 12; ++i) EXPECT_EQ(at<double>(bytes, 40 + 8 * i), doubles[i]) << i;
  expect_seal(bytes);
}

TEST(MapFile, descriptors_have_the_documented_layout) {
  const TemporaryFolder folder;
  write_map(folder.path(), small_map());
  const std::string bytes = read_file(folder.path() / "Descriptor.bin");
  ASSERT_EQ(bytes.size(), 32U + 2 * 24 + 8);
  EXPECT_EQ(bytes.substr(0, 8), "CAIRNDSC");
  EXPECT_EQ(at<std::uint32_t>(bytes, 8), 3U);    // version
  EXPECT_EQ(at<std::uint32_t>(bytes, 12), 3U);   // bytes of a descriptor
  EXPECT_EQ(at<std::uint32_t>(bytes, 16), 0U);   // Hamming
  EXPECT_EQ(at<std::uint32_t>(bytes, 20), 24U);  // stride
  EXPECT_EQ(at<std::uint64_t>(bytes, 24), 2U);   // rows
  EXPECT_EQ(at<float>(bytes, 40), 31);           // size
  EXPECT_EQ(at<float>(bytes, 44), 1.2F);         // sigma
  EXPECT_EQ(at<std::int32_t>(bytes, 56), 1);     // keyframe
  EXPECT_EQ(at<std::int32_t>(bytes, 60), 1);     // feature
  EXPECT_EQ(bytes.substr(72, 8), std::string("\x10\x11\x12\0\0\0\0\0", 8));
  expect_seal(bytes);
}

TEST(MapFile, texts_are_as_documented) {
  const TemporaryFolder folder;
  write_map(folder.path(), small_map());
  EXPECT_NE(read_file(folder.path() / "poses.txt").find("\n1.500000001 0 0.25 1e-12 0 0 0 1\n"),
            std::string::npos);
  const std::string json = read_file(folder.path() / "map.json");
  for (const char* text :
       {"\"descriptor\": {\"name\": \"ORB\", \"norm\": \"hamming\", \"bytes\": 3}",
        "\"counts\": {\"keyframes\": 2, \"features\": 4, \"landmarks\": 1, \"sightings\": 2}",
        "{\"file\": \"frames/000001.orb\", \"frame\": 8, \"stamp_ns\": 1500000001, \"part\": 0, \"crc32\": "})
    EXPECT_NE(json.find(text), std::string::npos) << text;
}

TEST(MapFile, what_is_erased_is_left_out) {
  const TemporaryFolder folder;
  write_map(folder.path(), scene_map());
  std::vector<std::string> names;
  for (const auto& [name, contents] : contents_of(folder.path())) names.push_back(name);
  EXPECT_EQ(names,
            (std::vector<std::string>{".cairn", "Descriptor.bin", "Place.bin", "Point.bin",
                                      "frames/000000.akaze", "frames/000001.akaze", "frames/000002.akaze",
                                      "frames/000003.akaze", "map.json", "poses.txt", "uvlist.txt"}));
  const std::string frame = read_file(folder.path() / "frames/000002.akaze");
  EXPECT_EQ(at<std::int32_t>(frame, 16),
            30);  // of the fourth keyframe, whose second feature shows landmark 0
  EXPECT_EQ(at<std::int32_t>(frame, 32 + 4), -1);
  EXPECT_EQ(at<std::int32_t>(frame, 32 + 36 + 61 + 4), 0);
}

TEST(MapFile, replaces_a_map_as_a_whole_and_nothing_else) {
  const TemporaryFolder folder;
  write_map(folder.path() / "map", scene_map());
  write_map(folder.path() / "map", small_map());
  EXPECT_EQ(contents_of(folder.path() / "map").size(), 9U);  // none of the files of before
  write_file(folder.path() / "notes.txt", "not of a map");
  EXPECT_THROW(write_map(folder.path(), small_map()), InputError);
}

TEST(MapFile, refuses_what_could_not_be_read) {
  const TemporaryFolder folder;
  const std::filesystem::path target = folder.path() / "map";
  EXPECT_THROW(write_map(target, Map(kSceneRig, "ORB")), PreconditionError);
  Map of_no_kind(kSceneRig, "BRIEF");
  of_no_kind.add_keyframe({}, {}, {}, 0);
  EXPECT_THROW(write_map(target, of_no_kind), PreconditionError);
  Map map = small_map();
  EXPECT_THROW(write_map(target, map, std::vector<Eigen::Matrix3d>(2)), PreconditionError);
  EXPECT_THROW(write_map(target, map, std::vector<Eigen::Matrix3d>{Eigen::Matrix3d::Constant(NAN)}),
               PreconditionError);
  map.move(LandmarkId{0}, {0, 0, INFINITY});
  EXPECT_THROW(write_map(target, map), PreconditionError);
  EXPECT_FALSE(std::filesystem::exists(target));
}

}  // namespace
}  // namespace cairn
