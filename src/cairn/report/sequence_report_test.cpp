// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/sequence_report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace cairn {
namespace {

Sequence rgbd_sequence() {
  Sequence sequence;
  sequence.folder = "data/room";
  sequence.format = "TUM";
  sequence.calibration.camera = {CameraModel::pinhole, 640, 480, 525, 520, 319.5, 239.5, {}};
  sequence.calibration.depth = DepthCalibration{};
  sequence.calibration.depth->scale = 5000;
  sequence.calibration_source = "camera.yaml";
  sequence.frames.resize(3);
  sequence.frames[1].stamp_ns = 500'000'000;
  sequence.frames[2].stamp_ns = 1'000'000'000;
  sequence.report = {"time, nearest stamp", 4, 5, 0, 3, 0.0125, {}};
  return sequence;
}

TEST(SequenceReport, tells_format_frames_and_camera) {
  EXPECT_EQ(format_sequence_text(rgbd_sequence(), 0),
            R"(sequence     data/room
format       TUM
frames       3 over 1.00 s, 2.00 frames per second
association  3 of 4 colour images have a depth image (75.0 %), largest gap 12.5 ms (by time, nearest stamp)
camera       pinhole 640x480, fx 525 fy 520 cx 319.5 cy 239.5 px
             from camera.yaml
depth        5000 units per metre, registered to colour
truth        none
)");
}

TEST(SequenceReport, tells_what_to_beware_of) {
  Sequence sequence = rgbd_sequence();
  sequence.has_times = false;
  const std::string text = format_sequence_text(sequence, 2);
  EXPECT_NE(text.find("2.00 frames per second: assumed, as nothing states times or rate_hz\n"
                      "unreadable   2 frames, which other commands skip\n"),
            std::string::npos);
}

TEST(SequenceReport, tells_the_baseline_and_the_way_of_the_truth) {
  Sequence sequence = rgbd_sequence();
  sequence.calibration.depth.reset();
  sequence.calibration.baseline = 0.54;
  sequence.truth = Trajectory(3);
  (*sequence.truth)[1].world_from_camera.translation = {3, 4, 0};
  sequence.truth->back().world_from_camera.translation = {3, 4, 1};
  const std::string text = format_sequence_text(sequence, 0);
  EXPECT_NE(text.find("\nstereo       baseline 0.54 m\ntruth        3 poses, path 6.000 m\n"),
            std::string::npos);
  const auto json = nlohmann::json::parse(format_sequence_json(sequence, 0));
  EXPECT_EQ(json["baseline_m"], 0.54);
  EXPECT_TRUE(json["right_correction"].is_null());
  sequence.calibration.right_correction.emplace().disparity = {0.5, 0, -1};
  EXPECT_NE(format_sequence_text(sequence, 0).find("baseline 0.54 m, right images corrected\n"),
            std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(format_sequence_json(sequence, 0))["right_correction"]["disparity_px"][2],
            -1);
  EXPECT_TRUE(json["depth_scale"].is_null());
  EXPECT_EQ(json["truth_poses"], 3);
  EXPECT_EQ(json["truth_path_m"], 6.0);
}

TEST(SequenceReport, has_in_json_what_the_text_has) {
  const auto json = nlohmann::json::parse(format_sequence_json(rgbd_sequence(), 2));
  EXPECT_EQ(json["sequence"], "data/room");
  EXPECT_EQ(json["frames"], 3);
  EXPECT_EQ(json["unreadable"], 2);
  EXPECT_EQ(json["duration_s"], 1.0);
  EXPECT_EQ(json["rate_hz"], 2.0);
  EXPECT_EQ(json["associated"], 3);
  EXPECT_EQ(json["camera"]["model"], "pinhole");
  EXPECT_EQ(json["camera"]["cy"], 239.5);
  EXPECT_EQ(json["depth_scale"], 5000.0);
  EXPECT_TRUE(json["raw_stereo"].is_null());
  EXPECT_TRUE(json["oxts"].is_null());
}

TEST(SequenceReport, tells_how_a_raw_pair_is_rectified) {
  Sequence sequence = rgbd_sequence();
  sequence.calibration.raw_stereo = RawStereo{};
  RawStereo& raw = *sequence.calibration.raw_stereo;
  raw.pair.left = raw.pair.right = sequence.calibration.camera;
  raw.pair.right.fx = 530;
  raw.pair.left_from_right.translation = {0.54, 0, 0};
  raw.rectification.rectified_from_left = Eigen::Quaterniond(0.5, 0.5, 0.5, 0.5);
  raw.rectification.rectified_from_right = Eigen::Quaterniond::Identity();
  sequence.calibration.baseline = 0.54;
  EXPECT_NE(format_sequence_text(sequence, 0)
                .find("             rectified on load, left turned by 120.00 degrees, right by 0.00\n"),
            std::string::npos);
  const auto json = nlohmann::json::parse(format_sequence_json(sequence, 0))["raw_stereo"];
  EXPECT_EQ(json["right"]["fx"], 530.0);
  EXPECT_EQ(json["left_from_right"]["translation"], (std::vector<double>{0.54, 0, 0}));
  EXPECT_EQ(json["rectified_from_left_xyzw"], (std::vector<double>{0.5, 0.5, 0.5, 0.5}));
}

}  // namespace
}  // namespace cairn
