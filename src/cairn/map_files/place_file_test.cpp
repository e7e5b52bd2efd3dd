// SPDX-License-Identifier: Apache-2.0
#include "cairn/map_files/place_file.h"

#include <gtest/gtest.h>

#include <cstring>

#include "cairn/core/error.h"
#include "cairn/core/file.h"
#include "cairn/core/random.h"
#include "cairn/map_files/map_writer.h"
#include "cairn/testing/core/temporary_folder.h"
#include "cairn/testing/map_files/scene_map.h"

namespace cairn {
namespace {

using testkit::kSceneRig;
using testkit::TemporaryFolder;

constexpr std::size_t kBytes = 128;

/// Landmarks that look different, each seen by `observations` keyframes in much the same way.
struct Places {
  Places(const std::filesystem::path& folder, std::int32_t landmarks, std::int32_t observations)
      : looks(Norm::l2, kBytes, static_cast<std::size_t>(landmarks)) {
    MapHeader header;
    header.rig = kSceneRig;
    header.descriptor = {"SIFT", Norm::l2, kBytes};
    std::filesystem::create_directories(folder);
    MapWriter writer(folder, header);
    for (std::int32_t k = 0; k < observations; ++k) {
      ObservedFrame frame;
      frame.features.descriptors = Descriptors(Norm::l2, kBytes, 0);
      writer.add_frame(frame, {}, {});
    }
    Random random(11);
    for (std::int32_t i = 0; i < landmarks; ++i) {
      std::uint8_t* look = looks.row(static_cast<std::size_t>(i));
      for (std::size_t b = 0; b < kBytes; ++b) look[b] = static_cast<std::uint8_t>(random.index(100));
      writer.add_landmark(landmark(look, observations, random));
    }
    writer.finish();
    MapWriter::discard_append_files(folder);
  }

  static FinishedLandmark landmark(const std::uint8_t* look, std::int32_t observations, Random& random) {
    FinishedLandmark result;
    result.descriptors = Descriptors(Norm::l2, kBytes, static_cast<std::size_t>(observations));
    for (std::int32_t k = 0; k < observations; ++k) {
      result.observations.push_back({{k}, 0});
      result.keypoints.emplace_back();
      std::uint8_t* row = result.descriptors.row(static_cast<std::size_t>(k));
      for (std::size_t b = 0; b < kBytes; ++b) row[b] = static_cast<std::uint8_t>(look[b] + random.index(4));
    }
    return result;
  }

  Descriptors looks;
};

TEST(PlaceFile, finds_landmarks_by_their_look) {
  const TemporaryFolder folder;
  constexpr std::int32_t kLandmarks = 3000;
  const Places places(folder.path() / "map", kLandmarks, 6);
  const PlaceFile file(folder.path() / "map", read_map_info(folder.path() / "map/map.json"));
  const auto found = file.find(places.looks, 0.45, 2);
  ASSERT_EQ(std::ssize(found), kLandmarks);
  int right = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    for (std::size_t k = 0; k + 1 < found[i].size(); ++k)
      EXPECT_LE(found[i][k].distance, found[i][k + 1].distance);
    right += !found[i].empty() && found[i].front().landmark == i ? 1 : 0;
  }
  EXPECT_GT(right, 0.9 * kLandmarks);
  Random random(12);
  Descriptors others(Norm::l2, kBytes, 500);
  for (std::size_t i = 0; i < others.count(); ++i)
    for (std::size_t b = 0; b < kBytes; ++b) others.row(i)[b] = static_cast<std::uint8_t>(random.index(100));
  for (const auto& neighbours : file.find(others, 0.45, 2)) EXPECT_TRUE(neighbours.empty());
  EXPECT_THROW((void)file.find(Descriptors(Norm::hamming, 32, 1), 0.45, 2), PreconditionError);
}

TEST(PlaceFile, is_a_quarter_of_the_observations) {
  const TemporaryFolder folder;
  const Places one(folder.path() / "one", 1000, 1), four(folder.path() / "four", 1000, 4),
      five(folder.path() / "five", 1000, 5);
  const auto bytes = [&](const char* name) {
    return static_cast<double>(std::filesystem::file_size(folder.path() / name / "Place.bin"));
  };
  EXPECT_NEAR(bytes("four") / bytes("one"), 1.0, 0.1);
  EXPECT_NEAR(bytes("five") / bytes("one"), 2.0, 0.2);
}

TEST(PlaceFile, impossible_counts_are_refused_though_the_checksums_fit) {
  const TemporaryFolder folder;
  const Places places(folder.path() / "map", 300, 4);
  const auto path = folder.path() / "map/Place.bin";
  const std::string whole = read_file(path);
  MapInfo info = read_map_info(folder.path() / "map/map.json");
  for (const std::size_t offset : {12U, 16U, 20U, 24U, 28U, 32U, 36U, 40U, 44U, 54U, 56U}) {
    std::string body = whole.substr(0, *sealed_bytes(whole.size()));
    const std::uint32_t value = 0xFFFF'FFF0U;
    std::memcpy(body.data() + offset, &value, sizeof value);
    BlockSeal seal;
    seal.add(body);
    body += std::move(seal).finish();
    write_file(path, body);
    info.checksums["Place.bin"] = stored_checksum(body);
    EXPECT_THROW(PlaceFile(folder.path() / "map", info), InputError) << offset;
  }
}

}  // namespace
}  // namespace cairn
