// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/sequence.h"

#include <gtest/gtest.h>

#include <cmath>

#include "cairn/testing/core/message_of.h"
#include "cairn/testing/image/recording_folder.h"

namespace cairn {
namespace {

using testkit::kSmallCamera;
using testkit::message_of;
using testkit::RecordingFolder;

namespace fs = std::filesystem;

constexpr const char* kCamera = "camera: {width: 8, height: 6, fx: 10, fy: 10, cx: 3.5, cy: 2.5}\n";
constexpr const char* kCalibrationRemedy =
    "\n  Put a camera.yaml into the folder or give --camera FILE (README, \"Calibration\"); for the TUM "
    "benchmark "
    "--camera tum-fr1, tum-fr2 or tum-fr3.";

/// Ten numbered frames 100, 110, ... 190.
class SequenceTest : public testing::Test, protected RecordingFolder {
 protected:
  SequenceTest() {
    put("camera.yaml", kSmallCamera);
    for (int i = 100; i < 200; i += 10) {
      put_color("rgb/" + std::to_string(i) + ".png");
      put_depth("depth/" + std::to_string(i) + ".png");
    }
  }
  [[nodiscard]] std::vector<std::int64_t> numbers(const SequenceOptions& options) const {
    std::vector<std::int64_t> result;
    for (const FrameFiles& files : open_sequence(folder_, options).frames) result.push_back(files.number);
    return result;
  }
  [[nodiscard]] std::string refusal(const SequenceOptions& options = {}) const {
    return message_of([&] { return open_sequence(folder_, options); });
  }

  using Numbers = std::vector<std::int64_t>;
};

TEST_F(SequenceTest, frames_and_without_are_positions) {
  SequenceOptions options;
  options.frames = parse_frame_range("2:7:2", "--frames");
  EXPECT_EQ(numbers(options), (Numbers{120, 140, 160}));
  options.without = parse_frame_range("4:5", "--without");
  EXPECT_EQ(numbers(options), (Numbers{120, 160}));
  options.frames.reset();
  options.without = parse_frame_range("1:", "--without");
  EXPECT_EQ(numbers(options), (Numbers{100}));
}

TEST_F(SequenceTest, start_and_end_are_numbers_and_the_end_is_left_out) {
  SequenceOptions options;
  options.start_index = 115;
  options.end_index = 150;
  EXPECT_EQ(numbers(options), (Numbers{120, 130, 140}));
  options.frames = parse_frame_range("-7:", "--frames");
  EXPECT_EQ(numbers(options), (Numbers{130, 140}));
}

TEST_F(SequenceTest, a_selection_of_nothing_is_refused) {
  SequenceOptions options;
  options.frames = parse_frame_range("50:", "--frames");
  EXPECT_EQ(refusal(options), folder_.string() +
                                  ": expected at least one frame, found 0 of 10 frames after selection.\n"
                                  "  Widen --frames, --without, start_index or end_index.");
}

TEST_F(SequenceTest, a_camera_that_is_given_goes_before_the_folders_own) {
  SequenceOptions options;
  options.camera = "tum-fr3";
  EXPECT_EQ(open_sequence(folder_, options).calibration.camera.fx, 535.4);
  EXPECT_EQ(open_sequence(folder_, options).calibration_source, "tum-fr3");
  options.camera = write("other.yaml",
                         "camera: {width: 8, height: 6, fx: 77, fy: 10, cx: 3, cy: 2}\n"
                         "depth: {scale: 1}\n")
                       .string();
  EXPECT_EQ(open_sequence(folder_, options).calibration.camera.fx, 77);
  EXPECT_EQ(open_sequence(folder_).calibration_source, (folder_ / "camera.yaml").string());
}

TEST_F(SequenceTest, a_camera_that_is_not_there_is_refused_with_the_known_names) {
  SequenceOptions options;
  options.camera = "tum-fr4";
  EXPECT_EQ(refusal(options),
            "--camera: expected a camera.yaml, or tum-fr1, tum-fr2, tum-fr3, or fx,fy,cx,cy[,scale], found "
            "'tum-fr4', no such file.\n"
            "  Check the path.");
}

TEST_F(SequenceTest, parameters_go_before_the_calibration) {
  SequenceOptions options;
  options.camera_parameters.fy = 12;
  options.camera_parameters.scale = 500;
  const Calibration calibration = open_sequence(folder_, options).calibration;
  EXPECT_EQ(calibration.camera.fx, 10);
  EXPECT_EQ(calibration.camera.fy, 12);
  EXPECT_EQ(calibration.depth->scale, 500);
}

TEST_F(SequenceTest, parameters_alone_make_a_calibration) {
  fs::remove(folder_ / "camera.yaml");
  SequenceOptions options;
  options.camera_parameters = {20.0, 21.0, 4.0, 3.0, 1000.0};
  const Sequence sequence = open_sequence(folder_, options);
  EXPECT_EQ(sequence.calibration.camera.width, 8);
  EXPECT_EQ(sequence.calibration.camera.height, 6);
  EXPECT_EQ(sequence.calibration.camera.fy, 21);
  EXPECT_EQ(sequence.calibration_source, "the parameters");
  options.camera_parameters.cx.reset();
  EXPECT_EQ(refusal(options),
            folder_.string() + ": expected a calibration, found none." + kCalibrationRemedy);
}

TEST_F(SequenceTest, parameters_that_make_no_camera_are_refused) {
  SequenceOptions options;
  options.camera_parameters.fx = 0;
  EXPECT_EQ(refusal(options), "camera.fx: expected pixels above 0, found 0.\n  Correct the value.");
  options.camera_parameters = {};
  options.camera_parameters.scale = -5;
  EXPECT_EQ(refusal(options),
            "camera.scale: expected units per metre above 0, found -5.\n  Correct the value.");
}

TEST_F(SequenceTest, no_calibration_is_refused) {
  fs::remove(folder_ / "camera.yaml");
  EXPECT_EQ(refusal(), folder_.string() + ": expected a calibration, found none." + kCalibrationRemedy);
}

TEST_F(SequenceTest, depth_without_a_scale_is_refused) {
  put("camera.yaml", kCamera);
  EXPECT_EQ(refusal(),
            (folder_ / "camera.yaml").string() +
                ": expected 'depth: {scale: ...}', units per metre, as the sequence has depth images, "
                "found none.\n  Add it (1000 where depth is in millimetres, 5000 for the TUM benchmark), of "
                "another program's calibration in a camera.yaml with 'depth' alone, or a fifth number to "
                "--camera fx,fy,cx,cy.");
}

TEST_F(SequenceTest, what_is_no_sequence_is_refused) {
  make_empty();
  EXPECT_TRUE(
      refusal().ends_with("found an empty folder.\n  Name the folder that holds these files, or the "
                          "images by --color and --depth or by --left and --right."));
  put("notes.txt", "hello");
  EXPECT_TRUE(refusal().find(", found none of these.") != std::string::npos) << refusal();
  const auto open = [](const fs::path& path) { return message_of([&] { return open_sequence(path); }); };
  EXPECT_EQ(open(folder_ / "notes.txt"),
            (folder_ / "notes.txt").string() +
                ": expected a folder with a sequence, found a file.\n  Check the path.");
  EXPECT_EQ(open(folder_ / "none"), (folder_ / "none").string() +
                                        ": expected a folder with a sequence, found nothing of that name.\n"
                                        "  Check the path.");
}

TEST_F(SequenceTest, a_link_to_a_sequence_is_one) {
  fs::create_directory_symlink(folder_, folder_ / "link");
  EXPECT_EQ(open_sequence(folder_ / "link").frames.size(), 10U);
}

TEST_F(SequenceTest, links_in_a_circle_are_refused_by_name) {
  fs::remove(folder_ / "camera.yaml");
  fs::create_symlink("camera.yaml", folder_ / "camera.yaml");
  EXPECT_EQ(refusal(), (folder_ / "camera.yaml").string() +
                           ": expected a readable file or folder, found Too many levels of symbolic links.\n"
                           "  Check the path and its permissions.");
}

TEST_F(SequenceTest, a_folder_that_may_not_be_read_is_refused_by_name) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may read everything";
  fs::permissions(folder_ / "rgb", fs::perms::owner_exec);
  const std::string message = refusal();
  fs::permissions(folder_ / "rgb", fs::perms::owner_all);
  EXPECT_EQ(message, (folder_ / "rgb").string() +
                         ": expected a readable file or folder, found Permission denied.\n"
                         "  Check the path and its permissions.");
}

TEST_F(SequenceTest, poses_of_the_depth_camera_become_those_of_the_colour_camera) {
  const std::string depth =
      "depth: {scale: 1000, camera_from_depth: {translation: [0.1, 0, 0], quaternion_xyzw: [0, 0, 1, 0]}}\n";
  put("trajectory.txt", "100 1 2 3 0 0 0 1\n");
  put("camera.yaml", kCamera + depth + "poses_are: depth\n");
  const Rigid3 world_from_camera = open_sequence(folder_).truth->at(0).world_from_camera;
  const Rigid3 camera_from_depth{Eigen::Quaterniond(0, 0, 0, 1), {0.1, 0, 0}};
  const Eigen::Vector3d point_in_depth(0.3, -0.2, 1.5);
  EXPECT_LT(
      (world_from_camera * (camera_from_depth * point_in_depth) - (point_in_depth + Eigen::Vector3d(1, 2, 3)))
          .norm(),
      1e-12);
  put("camera.yaml", kCamera + depth);
  EXPECT_EQ(open_sequence(folder_).truth->at(0).world_from_camera.translation, Eigen::Vector3d(1, 2, 3));
}

}  // namespace
}  // namespace cairn
