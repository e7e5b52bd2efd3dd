// SPDX-License-Identifier: Apache-2.0
#include "cairn/dense/fuse_sequence.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "cairn/core/error.h"
#include "cairn/core/file.h"
#include "cairn/dense/test_scene.h"
#include "cairn/image/codec.h"
#include "cairn/sequence/given_poses.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;

constexpr int kFrames = 6;

RawDepthImage raw_depth(std::uint64_t seed) {
  const DepthImage metres = test_scene::depth_image(seed);
  RawDepthImage raw(metres.width(), metres.height());
  for (std::size_t i = 0; i < raw.size(); ++i)
    raw.data()[i] = static_cast<std::uint16_t>(1000.0F * metres.data()[i]);
  return raw;
}

/// A 7-Scenes folder of a few frames; frame 2 has no pose.
fs::path write_sequence(const std::string& name) {
  fs::path folder = test_scene::temporary_path(name);
  fs::remove_all(folder);
  fs::create_directories(folder);
  write_file(folder / "camera.yaml",
             "camera: {model: pinhole, width: 64, height: 48, fx: 52.5, fy: 52.5, cx: 31.5, cy: 23.5, "
             "distortion: []}\ndepth: {scale: 1000.0, invalid: [0]}\n");
  for (int i = 0; i < kFrames; ++i) {
    const std::string stem = fmt::format("frame-{:06}", i);
    write_png(folder / (stem + ".color.png"), test_scene::color_image());
    write_png(folder / (stem + ".depth.png"), raw_depth(static_cast<std::uint64_t>(i)));
    const Rigid3 pose = test_scene::world_from_camera(i);
    const Eigen::Matrix3d r = pose.matrix3();
    std::string text;
    for (int row = 0; row < 3; ++row)
      text += fmt::format("{} {} {} {}\n", r(row, 0), r(row, 1), r(row, 2), pose.translation[row]);
    if (i != 2) write_file(folder / (stem + ".pose.txt"), text + "0 0 0 1\n");
  }
  return folder;
}

class Listener : public Progress {
 public:
  void warn(const std::string& message) override { warnings.push_back(message); }
  [[nodiscard]] bool stop_requested() const override { return stop; }
  std::vector<std::string> warnings;
  bool stop = false;
};

struct Fused {
  FusionReport report;
  Cloud cloud;
  OccupancyGrid::Counts counts;
};

Fused fuse(const fs::path& folder, int threads, Progress& progress) {
  const Sequence sequence = open_sequence(folder);
  CloudBuilder cloud;
  OccupancyGrid grid;
  Fused fused;
  fused.report =
      fuse_sequence(sequence, poses_of_frames(sequence, {}), {&cloud, &grid}, Executor(threads), progress);
  fused.cloud = cloud.take();
  fused.counts = grid.counts();
  return fused;
}

TEST(FuseSequence, CountsFramesWithoutPoseAndIsTheSameAtAnyNumberOfThreads) {
  const fs::path folder = write_sequence("fuse");
  Progress silent;
  const Fused one = fuse(folder, 1, silent);
  EXPECT_EQ(one.report.frames, kFrames);
  EXPECT_EQ(one.report.fused, kFrames - 1);
  EXPECT_EQ(one.report.without_pose, 1);
  EXPECT_GT(one.counts.occupied, 100);
  for (const int threads : {2, 4}) {
    const Fused many = fuse(folder, threads, silent);
    EXPECT_EQ(many.cloud.points, one.cloud.points);
    EXPECT_EQ(many.counts.occupied, one.counts.occupied);
    EXPECT_EQ(many.counts.free, one.counts.free);
  }
}

TEST(FuseSequence, AnUnreadableFrameIsReportedAndLeftOut) {
  const fs::path folder = write_sequence("unreadable");
  write_file(folder / "frame-000003.depth.png", "no picture");
  Listener listener;
  const Fused fused = fuse(folder, 2, listener);
  EXPECT_EQ(fused.report.unreadable, 1);
  EXPECT_EQ(fused.report.fused, kFrames - 2);
  ASSERT_EQ(listener.warnings.size(), 1U);
  EXPECT_TRUE(listener.warnings[0].starts_with("frame 3 left out: ")) << listener.warnings[0];
  EXPECT_NE(listener.warnings[0].find("frame-000003.depth.png"), std::string::npos);
}

TEST(FuseSequence, NoReadableFrameIsAnInputError) {
  const fs::path folder = write_sequence("broken");
  for (int i = 0; i < kFrames; ++i) write_file(folder / fmt::format("frame-{:06}.color.png", i), "");
  Listener listener;
  EXPECT_THROW(fuse(folder, 1, listener), InputError);
}

TEST(FuseSequence, WithoutDepthItIsAnInputError) {
  Sequence sequence = open_sequence(write_sequence("flat"));
  sequence.calibration.depth.reset();
  Progress silent;
  EXPECT_THROW(
      fuse_sequence(sequence, std::vector<std::optional<WorldFromCamera>>(kFrames), {}, Executor(), silent),
      InputError);
}

TEST(FuseSequence, StopsWhenAsked) {
  Listener listener;
  listener.stop = true;
  const Fused fused = fuse(write_sequence("stop"), 1, listener);
  EXPECT_TRUE(fused.report.stopped);
  EXPECT_EQ(fused.report.fused, 1);
}

}  // namespace
}  // namespace cairn
