// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/camera_numbers.h"

#include <gtest/gtest.h>

#include "cairn/testing/core/message_of.h"
#include "cairn/testing/image/recording_folder.h"

namespace cairn {
namespace {

using testkit::kSmallCamera;
using testkit::message_of;
using testkit::RecordingFolder;

class CameraNumbersTest : public testing::Test, protected RecordingFolder {
 protected:
  CameraNumbersTest() {
    put_color("rgb/1.png");
    put_depth("depth/1.png");
  }
  [[nodiscard]] Sequence open(const std::string& camera) const {
    SequenceOptions options;
    options.camera = camera;
    return open_sequence(folder_, options);
  }
};

TEST_F(CameraNumbersTest, make_the_camera_of_a_sequence) {
  const Sequence sequence = open("10,11,3.5,2.5,5000");
  put("camera.yaml",
      "camera: {width: 8, height: 6, fx: 10, fy: 11, cx: 3.5, cy: 2.5}\ndepth: {scale: 5000}\n");
  const Calibration file = open("").calibration;
  EXPECT_EQ(sequence.calibration.camera.width, file.camera.width);
  EXPECT_EQ(sequence.calibration.camera.height, file.camera.height);
  EXPECT_EQ(sequence.calibration.camera.fx, file.camera.fx);
  EXPECT_EQ(sequence.calibration.camera.fy, file.camera.fy);
  EXPECT_EQ(sequence.calibration.camera.cx, file.camera.cx);
  EXPECT_EQ(sequence.calibration.camera.cy, file.camera.cy);
  EXPECT_EQ(sequence.calibration.depth.value().scale, file.depth.value().scale);
  EXPECT_EQ(sequence.calibration_source, "--camera");
}

TEST_F(CameraNumbersTest, keep_what_they_do_not_state_but_for_the_distortion) {
  put("camera.yaml",
      "camera: {model: radtan, distortion: [0.1, 0, 0, 0], width: 8, height: 6, fx: 9, fy: 9, cx: 3, cy: 2}\n"
      "depth: {scale: 1000}\nrate_hz: 15\n");
  const Calibration calibration = open("10,11,3.5,2.5").calibration;
  EXPECT_EQ(calibration.camera.model, CameraModel::pinhole);
  EXPECT_EQ(calibration.camera.distortion, Distortion{});
  EXPECT_EQ(calibration.camera.fx, 10);
  EXPECT_EQ(calibration.depth.value().scale, 1000);
  EXPECT_EQ(calibration.rate_hz, 15);
}

TEST_F(CameraNumbersTest, give_way_to_parameters) {
  SequenceOptions options;
  options.camera = "10,11,3.5,2.5,5000";
  options.camera_parameters.fy = 12;
  EXPECT_EQ(open_sequence(folder_, options).calibration.camera.fy, 12);
}

TEST_F(CameraNumbersTest, without_scale_are_too_few_for_depth) {
  EXPECT_TRUE(
      message_of([&] { return open("10,11,3.5,2.5"); }).starts_with("--camera: expected 'depth: {scale"));
}

TEST(ParseCameraNumbers, refuses_what_makes_no_camera) {
  constexpr const char* kRemedy =
      "\n  Give pixels, and after them the units of depth in a metre if there is depth.";
  for (const char* text : {"1,2,3", "1,2,3,4,5,6", "1,2,3,x", "1,2,,4", "1,2,3,4,", "1, 2,3,4"})
    EXPECT_EQ(message_of([&] { return parse_camera_numbers(text); }),
              "--camera: expected 4 or 5 numbers, fx,fy,cx,cy or fx,fy,cx,cy,scale, found '" +
                  std::string(text) + "'." + kRemedy);
  EXPECT_EQ(message_of([] { return parse_camera_numbers("0,1,2,3"); }),
            std::string("--camera: expected focal lengths above 0, found '0,1,2,3'.") + kRemedy);
  EXPECT_EQ(message_of([] { return parse_camera_numbers("1,1,2,3,0"); }),
            std::string("--camera: expected a scale above 0, found '1,1,2,3,0'.") + kRemedy);
  EXPECT_FALSE(parse_camera_numbers("tum-fr1"));
}

TEST_F(CameraNumbersTest, a_named_calibration_is_a_file_a_name_or_numbers) {
  EXPECT_EQ(read_named_calibration("tum-fr3").camera.fx, 535.4);
  EXPECT_EQ(read_named_calibration(write("a,b.yaml", kSmallCamera)).camera.fx, 10);
  const Calibration numbers = read_named_calibration("10,11,3.5,2.5");
  EXPECT_EQ(numbers.camera.cy, 2.5);
  EXPECT_EQ(numbers.camera.width, 0);
  EXPECT_FALSE(numbers.depth);
}

}  // namespace
}  // namespace cairn
