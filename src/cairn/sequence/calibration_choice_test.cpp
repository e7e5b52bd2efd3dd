// SPDX-License-Identifier: Apache-2.0
// Which calibration a sequence gets: its format's, another program's, and what a camera.yaml without camera
// adds.
#include <gtest/gtest.h>

#include <string>

#include "cairn/image/codec.h"
#include "cairn/sequence/sequence.h"
#include "cairn/testing/core/temporary_folder.h"

namespace cairn {
namespace {

constexpr const char* kBody =
    "body: {body_from_camera: {translation: [1, 2, 3], quaternion_xyzw: [0, 0, 0, 1]}}\n";

std::string ros_camera(std::string_view fourth_of_projection) {
  return "image_width: 8\nimage_height: 6\ncamera_matrix: {rows: 3, cols: 3, data: [10, 0, 4, 0, 10, 3, 0, "
         "0, 1]}\n"
         "distortion_model: plumb_bob\ndistortion_coefficients: {rows: 1, cols: 5, data: [0, 0, 0, 0, 0]}\n"
         "rectification_matrix: {rows: 3, cols: 3, data: [1, 0, 0, 0, 1, 0, 0, 0, 1]}\n"
         "projection_matrix: {rows: 3, cols: 4, data: [10, 0, 4, " +
         std::string(fourth_of_projection) + ", 0, 10, 3, 0, 0, 0, 1, 0]}\n";
}

class CalibrationChoiceTest : public testing::Test {
 protected:
  /// A stereo sequence of KITTI's layout, two frames.
  void make_pairs() const {
    for (const char* camera : {"image_0", "image_1"}) {
      for (const char* name : {"000000.png", "000001.png"})
        write_png(folder_.make_folder(camera) / name, GrayImage(8, 6, 90));
    }
    write("calib.txt", "P0: 700 0 300 0 0 710 100 0 0 0 1 0\nP1: 700 0 300 -350 0 710 100 0 0 0 1 0\n");
    write("times.txt", "0\n0.1\n");
  }
  /// An RGB-D sequence in TUM's layout, without a calibration.
  void make_depth() const {
    write_png(folder_.make_folder("rgb") / "1.png", GrayImage(8, 6, 90));
    write_png(folder_.make_folder("depth") / "1.png", RawDepthImage(8, 6, 1000));
    write("rgb.txt", "1.0 rgb/1.png\n");
    write("depth.txt", "1.0 depth/1.png\n");
  }
  void write(const char* name, const std::string& text) const { folder_.write(name, text); }
  [[nodiscard]] Calibration read(const std::string& camera = {}) const {
    SequenceOptions options;
    options.camera = camera;
    return open_sequence(folder_.path(), options).calibration;
  }

  const testkit::TemporaryFolder folder_;
};

TEST_F(CalibrationChoiceTest, a_body_alone_completes_the_formats_own) {
  make_pairs();
  write("camera.yaml", kBody);
  const Calibration calibration = read();
  EXPECT_EQ(calibration.camera.fy, 710);
  EXPECT_EQ(calibration.baseline, 0.5);
  ASSERT_TRUE(calibration.body_from_camera);
  EXPECT_EQ(calibration.body_from_camera->translation, Eigen::Vector3d(1, 2, 3));
}

TEST_F(CalibrationChoiceTest, the_formats_own_goes_before_what_lies_beside_it) {
  make_pairs();
  write("camera_info.yaml", ros_camera("0"));
  EXPECT_EQ(read().camera.fy, 710);
  EXPECT_EQ(read((folder_ / "camera_info.yaml").string()).camera.fy, 10);
}

TEST_F(CalibrationChoiceTest, pairs_of_images_get_both_of_a_pair_of_ros_calibrations) {
  make_pairs();
  write("ros/left.yaml", ros_camera("0"));
  write("ros/right.yaml", ros_camera("-2"));
  for (const char* camera : {"ros/left.yaml", "ros"}) {
    const Calibration calibration = read((folder_ / camera).string());
    ASSERT_TRUE(calibration.raw_stereo) << camera;
    EXPECT_NEAR(*calibration.baseline, 0.2, 1e-12);
  }
}

TEST_F(CalibrationChoiceTest, a_depth_scale_alone_completes_another_programs_calibration) {
  make_depth();
  write("camera_info.yaml", ros_camera("0"));
  write("camera.yaml", std::string("depth: {scale: 1000}\n") + kBody);
  const Calibration calibration = read();
  EXPECT_EQ(calibration.camera.fx, 10);
  ASSERT_TRUE(calibration.depth && calibration.body_from_camera);
  EXPECT_EQ(calibration.depth->scale, 1000);
}

}  // namespace
}  // namespace cairn
