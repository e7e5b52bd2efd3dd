// SPDX-License-Identifier: Apache-2.0
#include "cairn/map/map_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>

#include "cairn/core/checksum.h"
#include "cairn/core/file.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;

ObservedFrame frame_with_two_features() {
  ObservedFrame frame;
  frame.frame = {7};
  frame.stamp_ns = 1'500'000'000;
  frame.features.descriptors = Descriptors(Norm::hamming, 3, 2);
  for (std::uint8_t b = 0; b < 3; ++b) {
    frame.features.descriptors.row(0)[b] = b;
    frame.features.descriptors.row(1)[b] = static_cast<std::uint8_t>(16 + b);
  }
  frame.observations = {{1.5, 2.5, 10.0, 1, 1}, {3.5, 4.5}};
  return frame;
}

Keyframe keyframe_with_two_features() {
  Keyframe keyframe;
  keyframe.observed = frame_with_two_features();
  keyframe.landmarks.resize(2);
  return keyframe;
}

template <class Value>
Value at(const std::string& bytes, std::size_t offset) {
  Value value;
  std::memcpy(&value, bytes.data() + offset, sizeof(Value));
  return value;
}

TEST(FrameFile, has_the_documented_layout) {
  const std::string bytes = format_frame_file(keyframe_with_two_features());
  constexpr std::size_t kHeader = 28, kRecord = 23;
  ASSERT_EQ(bytes.size(), kHeader + 2 * kRecord + 4);
  EXPECT_EQ(bytes.substr(0, 8), "CAIRNFRM");
  EXPECT_EQ(at<std::uint32_t>(bytes, 8), 1U);                     // version
  EXPECT_EQ(at<std::int32_t>(bytes, 12), 7);                      // frame
  EXPECT_EQ(at<std::uint32_t>(bytes, 16), 2U);                    // descriptors
  EXPECT_EQ(at<std::uint32_t>(bytes, 20), 3U);                    // bytes of each
  EXPECT_EQ(at<std::uint32_t>(bytes, 24), 0U);                    // Hamming
  EXPECT_EQ(at<std::uint32_t>(bytes, kHeader + kRecord), 1U);     // index
  EXPECT_EQ(at<std::int32_t>(bytes, kHeader + kRecord + 4), -1);  // landmark
  EXPECT_EQ(at<float>(bytes, kHeader + 8), 1.5F);
  EXPECT_EQ(at<float>(bytes, kHeader + 16), 10.0F);
  EXPECT_NE(at<float>(bytes, kHeader + kRecord + 16),
            at<float>(bytes, kHeader + kRecord + 16));  // no disparity: NaN
  EXPECT_EQ(bytes.substr(kHeader + kRecord + 20, 3), "\x10\x11\x12");
  EXPECT_EQ(at<std::uint32_t>(bytes, bytes.size() - 4),
            crc32(std::string_view(bytes).substr(0, bytes.size() - 4)));
}

TEST(MapFile, is_a_folder_with_poses_and_frames) {
  const fs::path folder = fs::temp_directory_path() / ("cairn_map_test_" + std::to_string(::getpid()));
  Map map({525, 525, 319.5, 239.5, 0.075}, "ORB");
  const KeyframeId keyframe = map.add_keyframe(frame_with_two_features(), {}, {}, 0);
  const LandmarkId landmark = map.add_landmark({0, 0, 2}, {keyframe, 1});
  write_map(folder, map);
  const std::string frame = read_file(folder / "frames" / "000007.orb");
  EXPECT_EQ(frame, format_frame_file(map[keyframe]));
  EXPECT_EQ(at<std::int32_t>(frame, 28 + 4), -1);
  EXPECT_EQ(at<std::int32_t>(frame, 28 + 23 + 4), landmark.value);
  EXPECT_NE(read_file(folder / "poses.txt").find("\n1.500000000 0.000000000"), std::string::npos);
  EXPECT_NE(read_file(folder / "map.json")
                .find("\"descriptor\": {\"name\": \"ORB\", \"norm\": \"hamming\", \"bytes\": 3}"),
            std::string::npos);
  fs::remove_all(folder);
}

}  // namespace
}  // namespace cairn
