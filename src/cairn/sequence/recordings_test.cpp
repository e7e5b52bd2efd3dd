// SPDX-License-Identifier: Apache-2.0
// The readers on recordings by others; skipped where these are absent.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cairn/sequence/given_poses.h"
#include "cairn/sequence/sequence.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;

class RecordingsTest : public testing::Test {
 protected:
  [[nodiscard]] fs::path folder() const { return fs::path(CAIRN_DATA_DIR) / "rgbd" / name_; }
  /// False, and the test is skipped or failed, where the recording is absent.
  [[nodiscard]] bool is_there(const char* name) {
    name_ = name;
    if (fs::exists(folder())) return true;
    EXPECT_EQ(std::getenv("CAIRN_REQUIRE_DATA"), nullptr) << folder() << " is missing";
    return false;
  }

 private:
  std::string name_;
};

double share_of_known(const DepthImage& depth) {
  const auto known = std::count_if(depth.data(), depth.data() + depth.size(), [](float z) { return z > 0; });
  return static_cast<double>(known) / static_cast<double>(depth.size());
}

TEST_F(RecordingsTest, redkitchen) {
  if (!is_there("redkitchen")) GTEST_SKIP() << "needs " << folder();
  const Sequence sequence = open_sequence(folder());
  EXPECT_EQ(sequence.format, "7-Scenes");
  EXPECT_EQ(sequence.frames.size(), 600U);
  EXPECT_EQ(sequence.calibration.poses_are, PosesAre::depth);
  ASSERT_TRUE(sequence.truth);
  EXPECT_EQ(sequence.truth->size(), 600U);
  const FrameLoader loader(sequence);
  for (const int i : {0, 599}) {
    const Frame frame = loader.load(FrameId{i});
    EXPECT_EQ(frame.gray.width(), 640);
    const double known = share_of_known(frame.depth);
    EXPECT_GT(known, 0.6);
    EXPECT_LT(known, 0.95);
    for (std::size_t k = 0; k < frame.depth.size(); ++k) ASSERT_LT(frame.depth.data()[k], 10.0F);
  }
}

/// frame-000000.pose.txt holds world_from_depth; the colour camera sits 2 cm beside.
TEST_F(RecordingsTest, redkitchen_poses_are_those_of_the_colour_camera) {
  if (!is_there("redkitchen")) GTEST_SKIP() << "needs " << folder();
  const Rigid3 world_from_camera = open_sequence(folder()).truth->front().world_from_camera;
  const Eigen::Vector3d depth_camera(-3.404563400000000239e-01, 1.646981800000000065e-02,
                                     2.965691699999999931e-01);
  EXPECT_LT((world_from_camera * Eigen::Vector3d(-0.02, 0, 0) - depth_camera).norm(), 1e-9);
}

TEST_F(RecordingsTest, fr1_desk_excerpt) {
  if (!is_there("fr1_desk_excerpt")) GTEST_SKIP() << "needs " << folder();
  const Sequence sequence = open_sequence(folder());
  EXPECT_EQ(sequence.format, "TUM");
  EXPECT_EQ(sequence.frames.size(), 9U);
  EXPECT_EQ(sequence.frames[0].stamp_ns, 1'305'031'453'359'684'000);
  EXPECT_EQ(sequence.calibration.camera.fx, 517.3);
  EXPECT_LT(sequence.report.max_stamp_gap_s, 0.02);
  const auto poses = poses_of_frames(sequence);
  EXPECT_EQ(std::count(poses.begin(), poses.end(), std::nullopt), 0);
  const Frame frame = FrameLoader(sequence).load(FrameId{8});
  EXPECT_EQ(frame.depth.height(), 480);
  EXPECT_GT(share_of_known(frame.depth), 0.5);
}

TEST_F(RecordingsTest, five_views) {
  if (!is_there("five_views")) GTEST_SKIP() << "needs " << folder();
  const Sequence sequence = open_sequence(folder());
  EXPECT_EQ(sequence.format, "numbered");
  ASSERT_EQ(sequence.frames.size(), 5U);
  EXPECT_EQ(sequence.frames[1].number, 144);
  for (const fs::path& path : {fs::path(), folder() / "trajectory.txt"}) {
    const auto poses = poses_of_frames(sequence, {.path = path});
    ASSERT_TRUE(poses[4]);
    EXPECT_NEAR(poses[4]->translation.x(), -1.55819, 1e-9);
  }
  const FrameLoader loader(sequence);
  for (int i = 0; i < 5; ++i) EXPECT_GT(share_of_known(loader.load(FrameId{i}).depth), 0.3);
}

}  // namespace
}  // namespace cairn
