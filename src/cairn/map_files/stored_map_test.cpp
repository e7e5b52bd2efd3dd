// SPDX-License-Identifier: Apache-2.0
#include "cairn/map_files/stored_map.h"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>

#include "cairn/core/error.h"
#include "cairn/core/file.h"
#include "cairn/core/random.h"
#include "cairn/map_files/map_file.h"
#include "cairn/testing/core/temporary_folder.h"
#include "cairn/testing/map_files/scene_map.h"

namespace cairn {
namespace {

using testkit::contents_of;
using testkit::kSceneRig;
using testkit::observe_points;
using testkit::scene_covariances;
using testkit::scene_map;
using testkit::TemporaryFolder;

namespace fs = std::filesystem;

TEST(StoredMap, has_what_the_whole_reader_has) {
  const TemporaryFolder folder;
  const Map written = scene_map();
  write_map(folder.path(), written, scene_covariances(written));
  const Map map = read_map(folder.path());
  const StoredMap view(folder.path());
  EXPECT_EQ(view.info().descriptor.name, "AKAZE");
  ASSERT_EQ(view.poses().size(), map.keyframes().size());
  for (const Landmark& landmark : map.landmarks()) {
    const StoredLandmark stored = view.landmark(landmark.id);
    EXPECT_EQ(stored.point_in_world, landmark.point_in_world);
    EXPECT_EQ(stored.covariance, read_covariances(folder.path())[landmark.id.index()]);
    std::vector<std::int32_t> keyframes;
    for (const ObservationRef& observation : landmark.observations)
      keyframes.push_back(observation.keyframe.value);
    const auto found = view.places().keyframes(stored.first_row, stored.observations);
    EXPECT_EQ(std::vector(found.begin(), found.end()), keyframes);
  }
  for (const Keyframe& keyframe : map.keyframes()) {
    const auto viewed = view.keyframe(keyframe.id);
    EXPECT_EQ(viewed->world_from_camera.translation, keyframe.world_from_camera.translation);
    std::size_t shown = 0;
    for (std::size_t i = 0; i < keyframe.landmarks.size(); ++i) {
      if (!keyframe.landmarks[i].valid()) continue;
      EXPECT_EQ(viewed->landmarks[shown], keyframe.landmarks[i]);
      EXPECT_EQ(viewed->keypoints[shown].size, keyframe.observed.features.keypoints[i].size);
      EXPECT_EQ(
          std::memcmp(viewed->descriptors.row(shown), keyframe.observed.features.descriptors.row(i), 61), 0);
      ++shown;
    }
    EXPECT_EQ(viewed->landmarks.size(), shown);
    EXPECT_EQ(view.keyframe(keyframe.id), viewed);  // kept
  }
  EXPECT_NO_THROW(view.check());
  EXPECT_THROW((void)view.landmark({static_cast<std::int32_t>(map.landmarks().size())}), PreconditionError);
  EXPECT_THROW((void)view.keyframe({-1}), PreconditionError);
}

TEST(StoredMap, the_main_component_has_the_most_keyframes) {
  Random random(3);
  Map map(kSceneRig, "ORB");
  for (int k = 0; k < 5; ++k)
    map.add_keyframe(observe_points({{0, 0, 3}}, {}, 32, random), {}, {}, k == 0 || k == 4 ? 0 : 7);
  const TemporaryFolder folder;
  write_map(folder.path(), map);
  const StoredMap view(folder.path());
  EXPECT_FALSE(view.in_main_component({0}));
  EXPECT_TRUE(view.in_main_component({1}));
}

void flip_bit(const fs::path& file, std::size_t byte) {
  std::fstream stream(file, std::ios::binary | std::ios::in | std::ios::out);
  stream.seekg(static_cast<std::streamoff>(byte));
  const int flipped = stream.get() ^ (1 << (byte % 8));
  stream.seekp(static_cast<std::streamoff>(byte));
  stream.put(static_cast<char>(flipped));
}

TEST(StoredMap, finds_flipped_bits_in_all_files) {
  const TemporaryFolder folder;
  write_map(folder.path(), scene_map());
  const auto open_and_check = [&] { StoredMap(folder.path()).check(); };
  for (const auto& [name, contents] : contents_of(folder.path())) {
    if (name == ".cairn") continue;  // the marker for whoever writes
    for (std::size_t i = 0; i < contents.size(); i += 1 + contents.size() / 60) {
      flip_bit(folder.path() / name, i);
      ASSERT_THROW(open_and_check(), InputError) << name << " at " << i;
      flip_bit(folder.path() / name, i);
    }
  }
  EXPECT_NO_THROW(open_and_check());
}

TEST(StoredMap, what_is_touched_is_checked) {
  const TemporaryFolder folder;
  write_map(folder.path(), scene_map());
  constexpr std::size_t kCovarianceOfLandmark2 = 24 + 2 * 112 + 50;
  flip_bit(folder.path() / kPointFile, kCovarianceOfLandmark2);
  const StoredMap view(folder.path());
  EXPECT_THROW((void)view.landmark({2}), InputError);
}

TEST(StoredMap, finds_every_missing_or_truncated_file) {
  const TemporaryFolder folder;
  write_map(folder.path(), scene_map());
  for (const auto& [name, contents] : contents_of(folder.path())) {
    if (name == ".cairn") continue;
    fs::remove(folder.path() / name);
    EXPECT_THROW(StoredMap(folder.path()).check(), InputError) << name;
    for (const std::size_t size :
         {std::size_t{0}, std::size_t{5}, contents.size() / 2, contents.size() - 1}) {
      write_file(folder.path() / name, contents.substr(0, size));
      EXPECT_THROW(StoredMap(folder.path()).check(), InputError) << name << " " << size;
    }
    write_file(folder.path() / name, contents);
  }
}

TEST(StoredMap, a_map_without_landmarks_can_be_viewed) {
  Map map(kSceneRig, "SIFT");
  map.add_keyframe({}, {}, {}, 0);
  const TemporaryFolder folder;
  write_map(folder.path(), map);
  const StoredMap view(folder.path());
  EXPECT_TRUE(view.keyframe({0})->landmarks.empty());
  EXPECT_NO_THROW(view.check());
}

}  // namespace
}  // namespace cairn
