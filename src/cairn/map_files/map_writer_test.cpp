// SPDX-License-Identifier: Apache-2.0
#include "cairn/map_files/map_writer.h"

#include <gtest/gtest.h>

#include <functional>
#include <optional>

#include "cairn/core/error.h"
#include "cairn/core/file.h"
#include "cairn/core/random.h"
#include "cairn/map_files/map_file.h"
#include "cairn/map_files/map_statistics.h"
#include "cairn/map_files/stored_map.h"
#include "cairn/testing/core/temporary_folder.h"
#include "cairn/testing/map_files/scene_map.h"

namespace cairn {
namespace {

using testkit::contents_of;
using testkit::kSceneRig;
using testkit::observe_points;
using testkit::TemporaryFolder;

namespace fs = std::filesystem;

constexpr std::int32_t kFrames = 6;  // and as many landmarks
constexpr std::size_t kDescriptorBytes = 61;

MapHeader header() {
  MapHeader header;
  header.rig = kSceneRig;
  header.width = 640;
  header.height = 480;
  header.descriptor = {"AKAZE", Norm::hamming, kDescriptorBytes};
  header.world = "east, north, up";
  header.origin = GeodeticOrigin{48.137, 11.575, 519.25};
  header.settings = "step: 1.5\n\"quoted\"\n";
  return header;
}

/// Frame i shows landmarks i and i + 1.
ObservedFrame frame(std::int32_t number) {
  Random random(7, static_cast<std::uint64_t>(number));
  ObservedFrame observed = observe_points({{0, 0, 5}, {1, 0, 6}}, {}, kDescriptorBytes, random);
  observed.frame = {number};
  observed.stamp_ns = 1'000'000'000 + number;
  return observed;
}

WorldFromCamera pose(std::int32_t number) {
  return WorldFromCamera({Eigen::Quaterniond::Identity(), {0.5 * number, 0, 0.1}});
}

/// Seen by the frame before its number and by the one of its number, as far as there are any.
FinishedLandmark landmark(std::int32_t number) {
  FinishedLandmark result;
  result.point_in_world = {number / 3.0, 1, 5};
  result.covariance = Eigen::Vector3d(0.01, 0.02, 0.5).asDiagonal();
  for (const std::int32_t feature : {1, 0})
    if (const std::int32_t shown = number - feature; shown >= 0 && shown < kFrames)
      result.observations.push_back({{shown}, feature});
  result.descriptors = Descriptors(Norm::hamming, kDescriptorBytes, result.observations.size());
  std::vector<PosedObservation> views;
  for (std::size_t i = 0; i < result.observations.size(); ++i) {
    const ObservedFrame observed = frame(result.observations[i].keyframe.value);
    const auto feature = static_cast<std::size_t>(result.observations[i].feature);
    result.keypoints.push_back(observed.features.keypoints[feature]);
    std::memcpy(result.descriptors.row(i), observed.features.descriptors.row(feature), kDescriptorBytes);
    views.push_back({pose(result.observations[i].keyframe.value).inverse(), observed.observations[feature]});
  }
  result.indicators = indicators_of(kSceneRig, result.point_in_world, views);
  return result;
}

using Step = std::function<void(MapWriter&)>;

/// Frames, and landmarks before and after the frames that show them.
std::vector<Step> steps() {
  std::vector<Step> steps;
  const auto add_frame = [&](std::int32_t i) {
    steps.emplace_back([i](MapWriter& writer) {
      const std::vector<LandmarkId> shown{{i}, {i + 1 < kFrames ? i + 1 : -1}};
      writer.add_frame(frame(i), shown, pose(i), i / 4);
    });
  };
  const auto add_landmark = [&](std::int32_t i) {
    steps.emplace_back([i](MapWriter& writer) { writer.add_landmark(landmark(i)); });
  };
  for (std::int32_t i = 0; i < 3; ++i) add_landmark(i);
  for (std::int32_t i = 0; i < kFrames; ++i) add_frame(i);
  for (std::int32_t i = 3; i < kFrames; ++i) add_landmark(i);
  return steps;
}

void make_folder(const fs::path& folder) {
  fs::remove_all(folder);
  fs::create_directories(folder);
}

void write_whole(const fs::path& folder) {
  make_folder(folder);
  MapWriter writer(folder, header());
  for (const Step& step : steps()) step(writer);
  writer.finish();
  MapWriter::discard_append_files(folder);
}

/// Saves before step `saved`, is gone before step `killed`, and goes on from what was saved.
void write_with_crash(const fs::path& folder, std::size_t saved, std::size_t killed) {
  make_folder(folder);
  const std::vector<Step> all = steps();
  std::optional<MapWriterState> state;
  {
    MapWriter writer(folder, header());
    for (std::size_t i = 0; i <= killed && i < all.size(); ++i) {
      if (i == saved) state = writer.save();
      if (i < killed) all[i](writer);
    }
    if (saved == all.size()) state = writer.save();
    if (killed > all.size()) writer.finish();  // gone when all was written
  }
  MapWriter writer(folder, header(), *state);
  for (std::size_t i = saved; i < all.size(); ++i) all[i](writer);
  writer.finish();
  MapWriter::discard_append_files(folder);
}

TEST(MapWriter, a_crash_at_any_step_changes_nothing) {
  const TemporaryFolder folder;
  write_whole(folder.path() / "whole");
  const auto expected = contents_of(folder.path() / "whole");
  for (std::size_t saved = 0; saved <= steps().size(); ++saved) {
    for (std::size_t killed = saved; killed <= steps().size() + 1; ++killed) {
      write_with_crash(folder.path() / "crashed", saved, killed);
      ASSERT_EQ(contents_of(folder.path() / "crashed"), expected) << saved << " " << killed;
    }
  }
}

TEST(MapWriter, half_written_frames_of_a_crash_are_gone) {
  const TemporaryFolder folder;
  make_folder(folder.path() / "map");
  MapWriterState state;
  {
    MapWriter writer(folder.path() / "map", header());
    writer.add_frame(frame(0), std::vector<LandmarkId>{{0}, {1}}, pose(0));
    state = writer.save();
  }
  write_file(folder.path() / "map/frames/000001.akaze", "of the run that crashed");
  write_file(folder.path() / "map/frames/000002.akaze.partial-1-2", "half");
  MapWriter writer(folder.path() / "map", header(), state);
  for (std::int32_t i = 0; i < 2; ++i) {
    FinishedLandmark only = landmark(i);
    only.observations = {{{0}, i}};
    only.keypoints.resize(1);
    only.descriptors = Descriptors(Norm::hamming, kDescriptorBytes, 1);
    std::memcpy(only.descriptors.row(0), frame(0).features.descriptors.row(static_cast<std::size_t>(i)),
                kDescriptorBytes);
    writer.add_landmark(only);
  }
  writer.finish();
  MapWriter::discard_append_files(folder.path() / "map");
  const Map map = read_map(folder.path() / "map");
  EXPECT_EQ(map.keyframes().size(), 1U);
  EXPECT_EQ(contents_of(folder.path() / "map").size(), 7U);
}

TEST(MapWriter, what_is_true_of_the_whole_map_comes_back) {
  const TemporaryFolder folder;
  write_whole(folder.path() / "map");
  const Map map = read_map(folder.path() / "map");
  EXPECT_EQ(map.header().width, 640);
  EXPECT_EQ(map.header().height, 480);
  EXPECT_EQ(map.header().world, header().world);
  EXPECT_EQ(map.header().origin, header().origin);
  EXPECT_EQ(map.header().settings, header().settings);
  EXPECT_EQ(std::ssize(map.keyframes()), kFrames);
  EXPECT_EQ(std::ssize(map.landmarks()), kFrames);
  write_map(folder.path() / "again", map, read_covariances(folder.path() / "map"));
  fs::remove(folder.path() / "again/.cairn");
  EXPECT_EQ(contents_of(folder.path() / "again"), contents_of(folder.path() / "map"));
}

/// Writes the whole map, whose landmarks from number `first` on have a covariance by noise.
void write_with_noise(const fs::path& folder, std::int32_t first) {
  make_folder(folder);
  MapWriter writer(folder, header());
  for (std::int32_t i = 0; i < kFrames; ++i) {
    const std::vector<LandmarkId> shown{{i}, {i + 1 < kFrames ? i + 1 : -1}};
    writer.add_frame(frame(i), shown, pose(i), i / 4);
    FinishedLandmark noisy = landmark(i);
    if (i >= first) noisy.noise_covariance = (1.0 + i) * Eigen::Matrix3d{{3, 1, 0}, {1, 4, -1}, {0, -1, 5}};
    writer.add_landmark(noisy);
    if (i == 1) (void)writer.save();
  }
  writer.finish();
  MapWriter::discard_append_files(folder);
}

TEST(MapWriter, covariances_by_noise_come_back) {
  const TemporaryFolder folder;
  write_with_noise(folder.path() / "map", 0);
  const StoredMap map(folder.path() / "map");
  for (std::int32_t i = 0; i < kFrames; ++i) {
    const Eigen::Matrix3d expected = (1.0 + i) * Eigen::Matrix3d{{3, 1, 0}, {1, 4, -1}, {0, -1, 5}};
    EXPECT_EQ(map.noise_covariance({i}), expected);
    EXPECT_EQ(map.landmark({i}).covariance, landmark(i).covariance);
  }
  EXPECT_NO_THROW(map.check());
  EXPECT_THROW((void)map.noise_covariance({kFrames}), PreconditionError);
}

TEST(MapWriter, without_covariances_by_noise_all_is_noise) {
  const TemporaryFolder folder;
  write_with_noise(folder.path() / "map", kFrames);
  EXPECT_FALSE(fs::exists(folder.path() / "map" / kNoiseFile));
  EXPECT_EQ(StoredMap(folder.path() / "map").noise_covariance({2}), landmark(2).covariance);
}

TEST(MapWriter, covariances_by_noise_of_some_landmarks_are_left_out) {
  const TemporaryFolder folder;
  write_with_noise(folder.path() / "map", 1);
  EXPECT_FALSE(fs::exists(folder.path() / "map" / kNoiseFile));
  EXPECT_NO_THROW(StoredMap(folder.path() / "map").check());
}

TEST(MapWriter, a_damaged_or_foreign_file_of_noise_is_found) {
  const TemporaryFolder folder;
  write_with_noise(folder.path() / "map", 0);
  const fs::path file = folder.path() / "map" / kNoiseFile;
  const std::string bytes = read_file(file);
  for (std::size_t i = 0; i < bytes.size(); i += 7) {
    std::string damaged = bytes;
    damaged[i] = static_cast<char>(damaged[i] ^ 4);
    write_file(file, damaged);
    EXPECT_THROW(StoredMap(folder.path() / "map").check(), InputError) << i;
    EXPECT_THROW((void)read_map_statistics(folder.path() / "map"), InputError) << i;
  }
  write_file(file, bytes.substr(0, bytes.size() / 2));
  EXPECT_THROW(StoredMap(folder.path() / "map").check(), InputError);
}

TEST(MapWriter, its_state_goes_through_a_file) {
  const TemporaryFolder folder;
  MapWriter map_writer(folder.path(), header());
  steps()[0](map_writer);
  steps()[3](map_writer);
  const MapWriterState state = map_writer.save();
  constexpr BinaryKind kKind{"TESTFILE", 1};
  BinaryWriter writer(kKind);
  state.put(writer);
  write_file(folder.path() / "state", std::move(writer).finish());
  BinaryReader reader(folder.path() / "state", kKind);
  const MapWriterState back = MapWriterState::get(reader);
  EXPECT_EQ(back.append_files, state.append_files);
  EXPECT_EQ(back.frames, 1);
  EXPECT_EQ(back.landmarks, 1U);
  EXPECT_EQ(back.features, 2U);
  EXPECT_EQ(back.observations, 1U);
}

TEST(MapWriter, refuses_what_no_map_can_have) {
  const TemporaryFolder folder;
  MapWriter writer(folder.path(), header());
  EXPECT_THROW(writer.finish(), PreconditionError);  // no frame
  FinishedLandmark unseen = landmark(1);
  unseen.observations.clear();
  EXPECT_THROW(writer.add_landmark(unseen), PreconditionError);
  FinishedLandmark twice = landmark(1);
  twice.observations[1].keyframe = twice.observations[0].keyframe;
  EXPECT_THROW(writer.add_landmark(twice), PreconditionError);
  FinishedLandmark nowhere = landmark(1);
  nowhere.point_in_world.x() = INFINITY;
  EXPECT_THROW(writer.add_landmark(nowhere), PreconditionError);
  FinishedLandmark of_another_kind = landmark(1);
  of_another_kind.descriptors = Descriptors(Norm::l2, 128, 2);
  EXPECT_THROW(writer.add_landmark(of_another_kind), PreconditionError);
  MapHeader unknown = header();
  unknown.descriptor.name = "BRIEF";
  EXPECT_THROW(MapWriter(folder.path(), unknown), PreconditionError);
}

}  // namespace
}  // namespace cairn
