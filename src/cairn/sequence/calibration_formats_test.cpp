// SPDX-License-Identifier: Apache-2.0
// Calibrations as other programs write them; each is to give the numbers of the same camera in camera.yaml.
#include "cairn/sequence/calibration_formats.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "cairn/core/text.h"
#include "cairn/sequence/sequence.h"
#include "cairn/testing/core/message_of.h"
#include "cairn/testing/image/recording_folder.h"

namespace cairn {
namespace {

using testkit::message_of;
using testkit::RecordingFolder;

constexpr const char* kPlain =
    "camera: {model: radtan, width: 640, height: 480, fx: 517.306408, fy: 516.469215, cx: 318.643040, cy: "
    "255.313989, "
    "distortion: [0.262383, -0.953104, -0.005358, 0.002628, 1.163314]}\n";
constexpr const char* kRos = R"(image_width: 640
image_height: 480
camera_name: narrow_stereo/left
camera_matrix:
  rows: 3
  cols: 3
  data: [517.306408, 0.000000, 318.643040, 0.000000, 516.469215, 255.313989, 0.000000, 0.000000, 1.000000]
distortion_model: plumb_bob
distortion_coefficients:
  rows: 1
  cols: 5
  data: [0.262383, -0.953104, -0.005358, 0.002628, 1.163314]
rectification_matrix:
  rows: 3
  cols: 3
  data: [1.000000, 0.000000, 0.000000, 0.000000, 1.000000, 0.000000, 0.000000, 0.000000, 1.000000]
projection_matrix:
  rows: 3
  cols: 4
  data: [517.0, 0.0, 318.0, 0.0, 0.0, 517.0, 255.0, 0.0, 0.0, 0.0, 1.0, 0.0]
)";

std::string replaced(std::string text, std::string_view what, std::string_view by) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), by);
}

class CalibrationFormatsTest : public testing::Test, protected RecordingFolder {
 protected:
  [[nodiscard]] Calibration read(const std::string& name, const std::string& text) const {
    return read_calibration(write(name, text));
  }
  void expect_plain(const std::string& name, const std::string& text) const {
    EXPECT_EQ(format_calibration(read(name, text)), format_calibration(read("camera.yaml", kPlain))) << text;
  }
};

TEST_F(CalibrationFormatsTest, ros_calibrations_are_read) {
  expect_plain("ost.yaml", kRos);
}

TEST_F(CalibrationFormatsTest, ros_messages_are_read_as_they_are_echoed) {
  expect_plain("echo.yaml", R"(header:
  seq: 12
  stamp:
    secs: 1305031102
    nsecs: 175304000
  frame_id: "/openni_rgb_optical_frame"
height: 480
width: 640
distortion_model: "plumb_bob"
D: [0.262383, -0.953104, -0.005358, 0.002628, 1.163314]
K: [517.306408, 0.0, 318.64304, 0.0, 516.469215, 255.313989, 0.0, 0.0, 1.0]
R: [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]
P: [517.0, 0.0, 318.0, 0.0, 0.0, 517.0, 255.0, 0.0, 0.0, 0.0, 1.0, 0.0]
binning_x: 0
binning_y: 0
roi:
  x_offset: 0
  do_rectify: False
---
)");
}

TEST_F(CalibrationFormatsTest, messages_of_the_second_ros_are_read_as_they_are_echoed) {
  expect_plain("echo2.yaml", R"(header:
  stamp:
    sec: 1305031102
    nanosec: 175304000
  frame_id: camera_color_optical_frame
height: 480
width: 640
distortion_model: rational_polynomial
d:
- 0.262383
- -0.953104
- -0.005358
- 0.002628
- 1.163314
- 0.0
- 0.0
- 0.0
k:
- 517.306408
- 0.0
- 318.64304
- 0.0
- 516.469215
- 255.313989
- 0.0
- 0.0
- 1.0
r:
- 1.0
---
)");
}

TEST_F(CalibrationFormatsTest, opencv_file_storage_is_read) {
  expect_plain("out_camera_data.yml", R"(%YAML:1.0
---
calibration_time: "Mon 02 Mar 2020 15:03:11"
nr_of_frames: 25
image_width: 640
image_height: 480
board_width: 9
square_size: 50.
flags: 0
fisheye_model: 0
camera_matrix: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 5.17306408e+02, 0., 3.18643040e+02, 0., 5.16469215e+02,
       2.55313989e+02, 0., 0., 1. ]
distortion_coefficients: !!opencv-matrix
   rows: 5
   cols: 1
   dt: d
   data: [ 2.62383e-01, -9.53104e-01, -5.358e-03, 2.628e-03,
       1.163314e+00 ]
avg_reprojection_error: 2.5e-01
)");
}

TEST_F(CalibrationFormatsTest, colmap_cameras_have_the_centre_of_the_first_pixel_at_a_half) {
  const std::string head =
      "# Camera list with one line of data per camera:\n"
      "#   CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]\n# Number of cameras: 1\n";
  const Camera opencv =
      read("cameras.txt", head + "1 OPENCV 640 480 500 501 320 240 0.1 -0.2 0.001 0.002\n").camera;
  EXPECT_EQ(opencv.model, CameraModel::radtan);
  EXPECT_EQ(opencv.fy, 501);
  EXPECT_EQ(opencv.cx, 319.5);
  EXPECT_EQ(opencv.cy, 239.5);
  EXPECT_EQ(opencv.distortion, (Distortion{0.1, -0.2, 0.001, 0.002, 0}));
  const Camera radial = read("cameras.txt", head + "1 SIMPLE_RADIAL 640 480 500 320 240 0.1\n").camera;
  EXPECT_EQ(radial.fy, 500);
  EXPECT_EQ(radial.distortion, (Distortion{0.1, 0, 0, 0, 0}));
  const Camera fisheye = read("cameras.txt", head + "1 RADIAL_FISHEYE 640 480 500 320 240 0.1 0.01\n").camera;
  EXPECT_EQ(fisheye.model, CameraModel::kb4);
  EXPECT_EQ(fisheye.distortion, (Distortion{0.1, 0.01, 0, 0, 0}));
  const Camera alike =
      read("cameras.txt", "1 PINHOLE 640 480 500 501 320 240\n2 PINHOLE 640 480 500 501 320 240\n").camera;
  EXPECT_EQ(alike.model, CameraModel::pinhole);
  const auto several = [&] {
    (void)read("cameras.txt", "1 PINHOLE 640 480 500 501 320 240\n2 PINHOLE 640 480 502 501 320 240\n");
  };
  EXPECT_NE(message_of(several).find("cameras.txt:2"), std::string::npos);
  EXPECT_NE(
      message_of([&] { (void)read("cameras.txt", "1 FOV 640 480 500 501 320 240 0.9\n"); }).find("'FOV'"),
      std::string::npos);
}

TEST_F(CalibrationFormatsTest, realsense_and_open3d_json_is_read) {
  expect_plain("intrinsics.json", R"({"width": 640, "height": 480, "ppx": 318.64304, "ppy": 255.313989,
    "fx": 517.306408, "fy": 516.469215, "model": "distortion.brown_conrady",
    "coeffs": [0.262383, -0.953104, -0.005358, 0.002628, 1.163314]})");
  const Calibration open3d =
      read("intrinsic.json",
           "{\n\t\"class_name\" : \"RGBDVideoMetadata\",\n\t\"depth_scale\" : 1000.0,\n"
           "\t\"height\" : 480,\n\t\"intrinsic_matrix\" :\n\t[\n\t\t525.0,\n\t\t0.0,\n\t\t0.0,\n"
           "\t\t0.0,\n\t\t526.0,\n\t\t0.0,\n\t\t319.5,\n\t\t239.25,\n\t\t1.0\n\t],\n"
           "\t\"width\" : 640\n}");
  EXPECT_EQ(open3d.camera.model, CameraModel::pinhole);
  EXPECT_EQ(open3d.camera.fy, 526);
  EXPECT_EQ(open3d.camera.cx, 319.5);
  EXPECT_EQ(open3d.camera.cy, 239.25);
  ASSERT_TRUE(open3d.depth);
  EXPECT_EQ(open3d.depth->scale, 1000);
  const Calibration nested =
      read("intrinsics.json",
           R"({"depth_scale": 0.001, "color": {"width": 640, "height": 480, "fx": 600.5, "fy": 600,
        "ppx": 320, "ppy": 240, "model": "Inverse Brown Conrady", "coeffs": [0, 0, 0, 0, 0]}})");
  EXPECT_EQ(nested.camera.fx, 600.5);
  EXPECT_EQ(nested.camera.model, CameraModel::pinhole);
  EXPECT_EQ(nested.depth->scale, 1000);
}

constexpr const char* kCamchain = R"(cam0:
  T_cam_imu:
  - [0.0, -1.0, 0.0, 0.25]
  - [1.0, 0.0, 0.0, -0.5]
  - [0.0, 0.0, 1.0, 0.0]
  - [0.0, 0.0, 0.0, 1.0]
  cam_overlaps: [1]
  camera_model: pinhole
  distortion_coeffs: [-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05]
  distortion_model: radtan
  intrinsics: [458.654, 457.296, 367.215, 248.375]
  resolution: [752, 480]
  rostopic: /cam0/image_raw
  timeshift_cam_imu: 0.0
cam1:
  T_cn_cnm1:
  - [1.0, 0.0, 0.0, -0.11]
  - [0.0, 1.0, 0.0, 0.001]
  - [0.0, 0.0, 1.0, 0.002]
  - [0.0, 0.0, 0.0, 1.0]
  cam_overlaps: [0]
  camera_model: pinhole
  distortion_coeffs: [-0.28368365, 0.07451284, -0.00010473, -3.55590700e-05]
  distortion_model: radtan
  intrinsics: [457.587, 456.134, 379.999, 255.238]
  resolution: [752, 480]
  rostopic: /cam1/image_raw
)";

TEST_F(CalibrationFormatsTest, camchains_of_kalibr_are_read) {
  const Calibration pair = read("camchain-imucam.yaml", kCamchain);
  const Calibration plain = read("camera.yaml", R"(
camera: {model: radtan, width: 752, height: 480, fx: 458.654, fy: 457.296, cx: 367.215, cy: 248.375, distortion: [-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05]}
right:
  camera: {model: radtan, width: 752, height: 480, fx: 457.587, fy: 456.134, cx: 379.999, cy: 255.238, distortion: [-0.28368365, 0.07451284, -0.00010473, -3.55590700e-05]}
  left_from_right: {translation: [0.11, -0.001, -0.002], quaternion_xyzw: [0, 0, 0, 1]}
body: {body_from_camera: {translation: [0.5, 0.25, 0], quaternion_xyzw: [0, 0, -0.7071067811865475, 0.7071067811865475]}}
)");
  EXPECT_EQ(format_calibration({.camera = pair.raw_stereo->pair.right}),
            format_calibration({.camera = plain.raw_stereo->pair.right}));
  EXPECT_DOUBLE_EQ(*pair.baseline, *plain.baseline);
  EXPECT_TRUE(pair.raw_stereo->pair.left_from_right.translation.isApprox(
      plain.raw_stereo->pair.left_from_right.translation, 1e-12));
  EXPECT_TRUE(pair.body_from_camera->translation.isApprox(plain.body_from_camera->translation, 1e-12));
  EXPECT_LT(pair.body_from_camera->rotation.angularDistance(plain.body_from_camera->rotation), 1e-12);
  const std::string fov = replaced(kCamchain, "distortion_model: radtan", "distortion_model: fov");
  EXPECT_NE(message_of([&] { (void)read("camchain.yaml", fov); }).find("'fov'"), std::string::npos);
  const std::string omni = replaced(kCamchain, "camera_model: pinhole", "camera_model: omni");
  EXPECT_NE(message_of([&] { (void)read("camchain.yaml", omni); }).find("'omni'"), std::string::npos);
}

/// Left and right of a rectification that turns each camera about its vertical axis.
TEST_F(CalibrationFormatsTest, a_pair_of_ros_calibrations_says_where_the_right_camera_sits) {
  const auto rectification = [](std::string_view r) {
    return fmt::format("data: [{}]\nprojection_matrix:", r);
  };
  constexpr std::string_view kIdentity =
      "data: [1.000000, 0.000000, 0.000000, 0.000000, 1.000000, 0.000000, 0.000000, 0.000000, 1.000000]\n"
      "projection_matrix:";
  const std::string left = replaced(kRos, kIdentity, rectification("0.96, 0, 0.28, 0, 1, 0, -0.28, 0, 0.96"));
  const std::string right =
      replaced(replaced(kRos, kIdentity, rectification("0.8, 0, 0.6, 0, 1, 0, -0.6, 0, 0.8")),
               "318.0, 0.0, 0.0", "318.0, -51.7, 0.0");
  put("left.yaml", left);
  put("right.yaml", right);
  const Calibration pair = read_ros_pair(folder_ / "left.yaml", folder_ / "right.yaml");
  const Rigid3& place = pair.raw_stereo->pair.left_from_right;
  // The left camera's rectified x axis, (0.96, 0, 0.28), 0.1 m long.
  EXPECT_TRUE(place.translation.isApprox(Eigen::Vector3d(0.096, 0, 0.028), 1e-12));
  EXPECT_NEAR(*pair.baseline, 0.1, 1e-12);
  const double angle = std::atan2(0.6, 0.8) - std::atan2(0.28, 0.96);
  EXPECT_LT(
      place.rotation.angularDistance(Eigen::Quaterniond(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitY()))),
      1e-12);
  EXPECT_NE(message_of([&] {
              (void)read_ros_pair(folder_ / "left.yaml", folder_ / "left.yaml");
            }).find("projection_matrix"),
            std::string::npos);
}

TEST_F(CalibrationFormatsTest, what_cairn_lacks_is_named) {
  const std::string prism =
      replaced(replaced(kRos, "plumb_bob", "rational_polynomial"), "1.163314]", "1.163314, 0.1, 0.2, 0.3]");
  EXPECT_NE(message_of([&] { (void)read("ost.yaml", prism); }).find("rational_polynomial"),
            std::string::npos);
  const std::string zero = replaced(kRos, "data: [517.306408", "data: [0");
  EXPECT_NE(message_of([&] { (void)read("ost.yaml", zero); }).find("focal lengths"), std::string::npos);
  EXPECT_NE(message_of([&] {
              (void)read("ost.yaml", replaced(kRos, "image_width: 640\n", ""));
            }).find("image_width"),
            std::string::npos);
  EXPECT_NE(message_of([&] {
              (void)read("camera.xml", "<?xml version=\"1.0\"?>\n<opencv_storage>\n");
            }).find("XML"),
            std::string::npos);
}

TEST_F(CalibrationFormatsTest, a_calibration_is_found_in_its_folder_under_its_usual_name) {
  EXPECT_FALSE(find_calibration(folder_));
  put("left.yaml", kRos);
  EXPECT_FALSE(find_calibration(folder_));  // one of a pair
  put("camera_info.yaml", kRos);
  EXPECT_EQ(find_calibration(folder_), folder_ / "camera_info.yaml");
  put("right.yaml", kRos);
  EXPECT_EQ(find_calibration(folder_), folder_ / "left.yaml");
  put("camera.yaml", "depth: {scale: 1000}\n");
  EXPECT_EQ(find_calibration(folder_), folder_ / "left.yaml");
  put("camera.yaml", kPlain);
  EXPECT_EQ(find_calibration(folder_), folder_ / "camera.yaml");
  EXPECT_EQ(format_calibration(read_calibration(folder_)),
            format_calibration(read_calibration(folder_ / "camera.yaml")));
}

}  // namespace
}  // namespace cairn
