// SPDX-License-Identifier: Apache-2.0
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
using testkit::message_for;
using testkit::observe_points;
using testkit::scene_covariances;
using testkit::scene_map;
using testkit::TemporaryFolder;

namespace fs = std::filesystem;

TEST(MapReader, writing_what_was_read_gives_the_same_bytes) {
  const TemporaryFolder folder;
  const Map map = scene_map();
  write_map(folder.path() / "first", map, scene_covariances(map));
  const Map back = read_map(folder.path() / "first");
  write_map(folder.path() / "second", back, read_covariances(folder.path() / "first"));
  EXPECT_EQ(contents_of(folder.path() / "first"), contents_of(folder.path() / "second"));
}

TEST(MapReader, a_map_comes_back) {
  const TemporaryFolder folder;
  const Map map = scene_map();
  write_map(folder.path(), map, scene_covariances(map));
  const Map back = read_map(folder.path());
  EXPECT_EQ(back.descriptor(), "AKAZE");
  EXPECT_EQ(back.rig().baseline, kSceneRig.baseline);
  ASSERT_EQ(back.keyframes().size(), 4U);
  ASSERT_EQ(back.landmarks().size(), 8U);
  const Keyframe &third = back.keyframes()[2], &written = map.keyframes()[3];
  EXPECT_EQ(third.component, 1);
  EXPECT_EQ(third.observed.frame, FrameId{30});
  EXPECT_EQ(third.observed.stamp_ns, written.observed.stamp_ns);
  EXPECT_EQ(third.world_from_camera.translation, written.world_from_camera.translation);
  EXPECT_EQ(third.landmarks[0], LandmarkId{});
  EXPECT_EQ(third.landmarks[1], LandmarkId{0});
  for (std::size_t i = 0; i < 10; ++i) {
    const Observation &seen = third.observed.observations[i], &old = written.observed.observations[i];
    EXPECT_NEAR(seen.u, old.u, 1e-4);
    EXPECT_EQ(seen.sigma_px, old.sigma_px);
    EXPECT_EQ(seen.has_disparity(), old.has_disparity());
    EXPECT_EQ(third.observed.points_in_camera[i].allFinite(), old.has_disparity());
    EXPECT_EQ(third.observed.features.keypoints[i].angle_deg, 12.5F);
    EXPECT_EQ(third.observed.features.keypoints[i].sigma_px, static_cast<float>(old.sigma_px));
    EXPECT_EQ(0, std::memcmp(third.observed.features.descriptors.row(i),
                             written.observed.features.descriptors.row(i), 61));
  }
  EXPECT_EQ(back.landmarks()[0].point_in_world, map.landmarks()[1].point_in_world);
  EXPECT_EQ(back.landmarks()[0].observations, (std::vector<ObservationRef>{{{1}, 1}, {{2}, 1}}));
  EXPECT_EQ(read_covariances(folder.path())[6], scene_covariances(map)[8]);
}

TEST(MapReader, parents_are_earlier_keyframes_of_the_component) {
  const TemporaryFolder folder;
  write_map(folder.path(), scene_map());
  const Map back = read_map(folder.path());
  EXPECT_FALSE(back.keyframes()[0].parent.valid());
  EXPECT_EQ(back.keyframes()[1].parent, KeyframeId{0});
  EXPECT_FALSE(
      back.keyframes()[2].parent.valid());  // shares landmarks with those before, of another component
  EXPECT_EQ(back.keyframes()[3].parent, KeyframeId{2});
}

TEST(MapReader, the_parent_is_the_one_with_most_landmarks_in_common) {
  Random random(5);
  const std::vector<Eigen::Vector3d> points{{0, 0, 3}, {1, 0, 3}, {0, 1, 3}};
  Map map(kSceneRig, "ORB");
  for (int k = 0; k < 4; ++k) map.add_keyframe(observe_points(points, {}, 32, random), {}, {k - 1}, 0);
  for (std::int32_t i = 0; i < 3; ++i) map.add_landmark(points[static_cast<std::size_t>(i)], {{0}, i});
  map.add_observation({0}, {{1}, 0});
  for (std::int32_t i = 0; i < 2; ++i) map.add_observation({i}, {{2}, i});
  const TemporaryFolder folder;
  write_map(folder.path(), map);
  const Map back = read_map(folder.path());
  EXPECT_EQ(back.keyframes()[2].parent, KeyframeId{0});  // two in common, with keyframe 1 one
  EXPECT_EQ(back.keyframes()[3].parent, KeyframeId{2});  // none in common with any
}

TEST(MapReader, rotations_and_infinite_variances_come_back_to_the_bit) {
  Random random(6);
  Map map(kSceneRig, "ORB");
  for (int k = 0; k < 50; ++k) {
    const Eigen::Quaterniond turn = rotation_exp({random.normal(), random.normal(), random.normal()});
    const Eigen::Quaterniond longer(turn.coeffs() * (1 + 1e-9 * random.normal()));
    map.add_keyframe(observe_points({{0, 0, 3}}, {}, 32, random), {longer, {random.normal(), 1e-9, 1e6}}, {},
                     k);
  }
  map.add_landmark({0, 0, 3}, {{7}, 0});
  const Eigen::Matrix3d unknown = Eigen::Vector3d(1, INFINITY, INFINITY).asDiagonal();
  const TemporaryFolder folder;
  write_map(folder.path() / "first", map, std::vector{unknown});
  write_map(folder.path() / "second", read_map(folder.path() / "first"),
            read_covariances(folder.path() / "first"));
  EXPECT_EQ(contents_of(folder.path() / "first"), contents_of(folder.path() / "second"));
}

TEST(MapReader, reads_the_map_of_a_run) {
  const TemporaryFolder folder;
  EXPECT_FALSE(find_map_folder(folder.path()));
  write_map(folder.path() / "map", scene_map());
  EXPECT_EQ(find_map_folder(folder.path()), folder.path() / "map");
  EXPECT_EQ(read_map(folder.path()).keyframes().size(), 4U);
}

TEST(MapReader, a_map_without_landmarks_or_features_comes_back) {
  Map map(kSceneRig, "sift");
  map.add_keyframe({}, {}, {}, 0);
  const TemporaryFolder folder;
  write_map(folder.path(), map);
  EXPECT_TRUE(read_map(folder.path()).landmarks().empty());
}

/// In place: to write the whole file for every byte of it takes long.
void flip_bit(const fs::path& file, std::size_t byte) {
  std::fstream stream(file, std::ios::binary | std::ios::in | std::ios::out);
  stream.seekg(static_cast<std::streamoff>(byte));
  const int flipped = stream.get() ^ (1 << (byte % 8));
  stream.seekp(static_cast<std::streamoff>(byte));
  stream.put(static_cast<char>(flipped));
}

/// One bit of each byte of each file.
TEST(MapReader, finds_every_flipped_bit) {
  const TemporaryFolder folder;
  write_map(folder.path(), scene_map());
  for (const auto& [name, contents] : contents_of(folder.path())) {
    if (name == ".cairn") continue;  // the marker for whoever writes
    for (std::size_t i = 0; i < contents.size(); ++i) {
      flip_bit(folder.path() / name, i);
      ASSERT_THROW((void)read_map(folder.path()), InputError) << name << " at " << i;
      flip_bit(folder.path() / name, i);
    }
  }
  EXPECT_EQ(message_for(folder.path()), "no error");
}

TEST(MapReader, finds_every_missing_or_truncated_file) {
  const TemporaryFolder folder;
  const fs::path map = folder.path() / "map";
  write_map(map, scene_map());
  for (const auto& [name, contents] : contents_of(map)) {
    if (name == ".cairn") continue;
    fs::remove(map / name);
    EXPECT_NE(message_for(map).find("MAP/" + name + ": expected a readable file"), std::string::npos)
        << message_for(map);
    for (const std::size_t size :
         {std::size_t{0}, std::size_t{5}, contents.size() / 2, contents.size() - 1}) {
      write_file(map / name, contents.substr(0, size));
      EXPECT_NE(message_for(map).find("MAP/" + name), std::string::npos) << name << size << message_for(map);
    }
    write_file(map / name, contents);
  }
}

TEST(MapReader, says_where_there_is_no_map) {
  const TemporaryFolder folder;
  EXPECT_EQ(message_for(folder.path()),
            "MAP: expected the folder of a map, or of a run with one in its map/, found none of its files.\n"
            "  Check the path; cairn map and cairn slam make maps.");
  EXPECT_NE(message_for(folder.path() / "no").find("found nothing of that name"), std::string::npos);
}

}  // namespace
}  // namespace cairn
