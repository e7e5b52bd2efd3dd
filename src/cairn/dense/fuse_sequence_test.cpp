// SPDX-License-Identifier: Apache-2.0
#include "cairn/dense/fuse_sequence.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "cairn/core/error.h"
#include "cairn/core/executor.h"
#include "cairn/core/progress.h"
#include "cairn/image/codec.h"
#include "cairn/sequence/given_poses.h"
#include "cairn/sequence/sequence.h"
#include "cairn/testing/core/temporary_folder.h"
#include "cairn/testing/image/depth_scene.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;

constexpr int kFrames = 6;

RawDepthImage raw_depth(std::uint64_t seed) {
  const DepthImage metres = testkit::depth_image(seed);
  RawDepthImage raw(metres.width(), metres.height());
  for (std::size_t i = 0; i < raw.size(); ++i)
    raw.data()[i] = static_cast<std::uint16_t>(1000.0F * metres.data()[i]);
  return raw;
}

/// A 7-Scenes folder of a few frames; frame 2 has no pose.
void write_sequence(const testkit::TemporaryFolder& folder) {
  folder.write("camera.yaml",
               "camera: {model: pinhole, width: 64, height: 48, fx: 52.5, fy: 52.5, cx: 31.5, cy: 23.5, "
               "distortion: []}\ndepth: {scale: 1000.0, invalid: [0]}\n");
  for (int i = 0; i < kFrames; ++i) {
    const std::string stem = fmt::format("frame-{:06}", i);
    write_png(folder / (stem + ".color.png"), testkit::color_image());
    write_png(folder / (stem + ".depth.png"), raw_depth(static_cast<std::uint64_t>(i)));
    const Rigid3 pose = testkit::walking_pose(i);
    const Eigen::Matrix3d r = pose.matrix3();
    std::string text;
    for (int row = 0; row < 3; ++row)
      text += fmt::format("{} {} {} {}\n", r(row, 0), r(row, 1), r(row, 2), pose.translation[row]);
    if (i != 2) folder.write(stem + ".pose.txt", text + "0 0 0 1\n");
  }
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
  const testkit::TemporaryFolder folder;
  write_sequence(folder);
  Progress silent;
  const Fused one = fuse(folder.path(), 1, silent);
  EXPECT_EQ(one.report.frames, kFrames);
  EXPECT_EQ(one.report.fused, kFrames - 1);
  EXPECT_EQ(one.report.without_pose, 1);
  EXPECT_GT(one.counts.occupied, 100);
  for (const int threads : {2, 4}) {
    const Fused many = fuse(folder.path(), threads, silent);
    EXPECT_EQ(many.cloud.points, one.cloud.points);
    EXPECT_EQ(many.counts.occupied, one.counts.occupied);
    EXPECT_EQ(many.counts.free, one.counts.free);
  }
}

TEST(FuseSequence, AnUnreadableFrameIsReportedAndLeftOut) {
  const testkit::TemporaryFolder folder;
  write_sequence(folder);
  folder.write("frame-000003.depth.png", "no picture");
  Listener listener;
  const Fused fused = fuse(folder.path(), 2, listener);
  EXPECT_EQ(fused.report.unreadable, 1);
  EXPECT_EQ(fused.report.fused, kFrames - 2);
  ASSERT_EQ(listener.warnings.size(), 1U);
  EXPECT_TRUE(listener.warnings[0].starts_with("frame 3 left out: ")) << listener.warnings[0];
  EXPECT_NE(listener.warnings[0].find("frame-000003.depth.png"), std::string::npos);
}

TEST(FuseSequence, NoReadableFrameIsAnInputError) {
  const testkit::TemporaryFolder folder;
  write_sequence(folder);
  for (int i = 0; i < kFrames; ++i) folder.write(fmt::format("frame-{:06}.color.png", i), "");
  Listener listener;
  EXPECT_THROW(fuse(folder.path(), 1, listener), InputError);
}

TEST(FuseSequence, WithoutDepthItIsAnInputError) {
  const testkit::TemporaryFolder folder;
  write_sequence(folder);
  Sequence sequence = open_sequence(folder.path());
  sequence.calibration.depth.reset();
  Progress silent;
  EXPECT_THROW(
      fuse_sequence(sequence, std::vector<std::optional<WorldFromCamera>>(kFrames), {}, Executor(), silent),
      InputError);
}

TEST(FuseSequence, StopsWhenAsked) {
  Listener listener;
  listener.stop = true;
  const testkit::TemporaryFolder folder;
  write_sequence(folder);
  const Fused fused = fuse(folder.path(), 1, listener);
  EXPECT_TRUE(fused.report.stopped);
  EXPECT_EQ(fused.report.fused, 1);
}

}  // namespace
}  // namespace cairn
