// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "cairn/core/file.h"
#include "cairn/image/codec.h"
#include "cairn/sequence/asl_sensor.h"
#include "cairn/sequence/given_poses.h"
#include "cairn/sequence/sequence.h"
#include "cairn/testing/core/message_of.h"
#include "cairn/testing/image/recording_folder.h"
#include "cairn/testing/image/wall.h"

namespace cairn {
namespace {

using testkit::largest_difference;
using testkit::message_of;
using testkit::RecordingFolder;
using testkit::see_wall;

namespace fs = std::filesystem;

const Camera kLeft{CameraModel::radtan, 120, 80, 90, 91, 58, 41, {-0.28, 0.07, 2e-4, 1e-5, 0}};
const Camera kRight{CameraModel::kb4, 120, 80, 85, 85, 61, 38, {0.0035, 0.0007, -0.002, 0.0002, 0}};
const Rigid3 kBodyFromLeft{rotation_exp({0.05, 0.1, 1.5}), {0.1, -0.2, 0.05}};
const Rigid3 kLeftFromRight{rotation_exp({0.01, -0.02, 0.03}), {0.11, 0.002, -0.003}};

std::string sensor_yaml(const Camera& camera, const Rigid3& body_from_sensor) {
  Eigen::Matrix<double, 3, 4> m;
  m << body_from_sensor.matrix3(), body_from_sensor.translation;
  std::vector<double> values;
  for (int i = 0; i < 12; ++i) values.push_back(m(i / 4, i % 4));
  const auto& k = camera.distortion;
  return fmt::format(
      "%YAML:1.0\nsensor_type: camera\nT_BS:\n  cols: 4\n  rows: 4\n  data: [{}, 0.0, 0.0, 0.0, 1.0]\n"
      "resolution: [{}, {}]\ncamera_model: pinhole\nintrinsics: [{}, {}, {}, {}] #fu, fv, cu, cv\n"
      "distortion_model: {}\ndistortion_coefficients: [{}, {}, {}, {}]\n",
      fmt::join(values, ", "), camera.width, camera.height, camera.fx, camera.fy, camera.cx, camera.cy,
      camera.model == CameraModel::kb4 ? "equidistant" : "radial-tangential", k[0], k[1], k[2], k[3]);
}

/// A pair that moves along a wall, in ASL layout, with the true poses of its body.
class EurocTest : public testing::Test, protected RecordingFolder {
 protected:
  static constexpr int kFrames = 3;

  EurocTest() { write_sequence("mav0/"); }

  void write_sequence(const std::string& root) const {
    std::string list = "#timestamp [ns],filename\r\n";
    std::string truth = "#timestamp, p_RS_R_x [m], ...\n";
    for (int i = 0; i < kFrames; ++i) {
      const Rigid3 world_from_left = world_from_left_at(i);
      list += fmt::format("{},{}.png\r\n", stamp(i), stamp(i));
      put_gray(fmt::format("{}cam0/data/{}.png", root, stamp(i)), see_wall(kLeft, world_from_left));
      put_gray(fmt::format("{}cam1/data/{}.png", root, stamp(i)),
               see_wall(kRight, world_from_left * kLeftFromRight));
      truth += truth_line(stamp(i) + 128, world_from_left * kBodyFromLeft.inverse());
    }
    put(root + "cam0/data.csv", list);
    put(root + "cam1/data.csv", list);
    put(root + "cam0/sensor.yaml", sensor_yaml(kLeft, kBodyFromLeft));
    put(root + "cam1/sensor.yaml", sensor_yaml(kRight, kBodyFromLeft * kLeftFromRight));
    put(root + "state_groundtruth_estimate0/data.csv", truth);
  }
  void put_gray(const std::string& name, const GrayImage& image) const {
    fs::create_directories((folder_ / name).parent_path());
    write_png(folder_ / name, image);
  }
  [[nodiscard]] static std::int64_t stamp(int frame) {
    return 1'403'715'273'262'142'976 + 50'000'000 * static_cast<std::int64_t>(frame);
  }
  [[nodiscard]] static Rigid3 world_from_left_at(int frame) {
    return {rotation_exp({0.02 * frame, 0.03, -0.01 * frame}), {0.2 * frame, -0.05 * frame, 0.1 * frame}};
  }
  [[nodiscard]] static std::string truth_line(std::int64_t stamp_ns, const Rigid3& pose) {
    const auto& t = pose.translation;
    const auto& q = pose.rotation;
    return fmt::format("{},{},{},{},{},{},{},{},0,0,0,0,0,0,0,0,0\n", stamp_ns, t.x(), t.y(), t.z(), q.w(),
                       q.x(), q.y(), q.z());
  }
  [[nodiscard]] std::string refusal() const {
    return message_of([&] { return open_sequence(folder_); });
  }
  void replace(const std::string& name, const std::string& old, const std::string& by) const {
    std::string text = read_file(folder_ / name);
    const std::size_t at = text.find(old);
    ASSERT_NE(at, std::string::npos) << old;
    put(name, text.replace(at, old.size(), by));
  }
};

TEST_F(EurocTest, pairs_images_with_stamps_in_nanoseconds) {
  const Sequence sequence = open_sequence(folder_);
  EXPECT_EQ(sequence.format, "EuRoC");
  ASSERT_EQ(sequence.frames.size(), 3U);
  EXPECT_EQ(sequence.frames[1].stamp_ns, stamp(1));
  EXPECT_EQ(sequence.frames[1].right.parent_path(), folder_ / "mav0/cam1/data");
  EXPECT_EQ(sequence.report.associated, 3);
  EXPECT_EQ(sequence.report.max_stamp_gap_s, 0);
}

TEST_F(EurocTest, needs_no_mav0) {
  make_empty();
  write_sequence("");
  EXPECT_EQ(open_sequence(folder_).frames.size(), 3U);
}

TEST_F(EurocTest, images_without_partner_are_left_out) {
  replace("mav0/cam1/data.csv", fmt::format("{0},{0}.png\r\n", stamp(1)), "");
  const Sequence sequence = open_sequence(folder_);
  ASSERT_EQ(sequence.frames.size(), 2U);
  EXPECT_EQ(sequence.frames[1].stamp_ns, stamp(2));
  EXPECT_EQ(sequence.report.color_images, 3);
  EXPECT_EQ(sequence.report.right_images, 2);
}

TEST_F(EurocTest, keeps_the_raw_cameras) {
  const Calibration calibration = open_sequence(folder_).calibration;
  ASSERT_TRUE(calibration.raw_stereo);
  const StereoPair& pair = calibration.raw_stereo->pair;
  EXPECT_EQ(pair.left.model, CameraModel::radtan);
  EXPECT_EQ(pair.left.distortion, kLeft.distortion);
  EXPECT_EQ(pair.right.model, CameraModel::kb4);
  EXPECT_EQ(pair.right.cx, kRight.cx);
  EXPECT_LT(left_perturbation(kLeftFromRight, pair.left_from_right).norm(), 1e-9);
  EXPECT_EQ(calibration.camera.model, CameraModel::pinhole);
  EXPECT_NEAR(*calibration.baseline, kLeftFromRight.translation.norm(), 1e-12);
}

/// Against the wall as rectified cameras see it.
TEST_F(EurocTest, frames_come_rectified) {
  const Sequence sequence = open_sequence(folder_);
  const Rigid3 left_from_right{Eigen::Quaterniond::Identity(), {*sequence.calibration.baseline, 0, 0}};
  const FrameLoader loader(sequence);
  for (int i = 0; i < kFrames; ++i) {
    const Rigid3& world_from_left = sequence.truth->at(static_cast<std::size_t>(i)).world_from_camera;
    const Frame frame = loader.load(FrameId{i});
    const Camera& camera = sequence.calibration.camera;
    EXPECT_LE(largest_difference(frame.gray, see_wall(camera, world_from_left)), 2);
    EXPECT_LE(largest_difference(frame.right, see_wall(camera, world_from_left * left_from_right)), 2);
    EXPECT_EQ(loader.load_color(FrameId{i})(60, 40).g, frame.gray(60, 40));
  }
}

TEST_F(EurocTest, truth_is_of_the_rectified_left_camera) {
  const Sequence sequence = open_sequence(folder_);
  const auto poses = poses_of_frames(sequence);
  const Eigen::Quaterniond& rectified_from_left =
      sequence.calibration.raw_stereo->rectification.rectified_from_left;
  for (int i = 0; i < kFrames; ++i) {
    const auto& found = poses[static_cast<std::size_t>(i)];
    ASSERT_TRUE(found);
    const Rigid3 wanted = world_from_left_at(i) * Rigid3{rectified_from_left, {0, 0, 0}}.inverse();
    EXPECT_LT(left_perturbation(wanted, *found).norm(), 1e-6);  // the stamps differ by 128 ns
  }
}

/// Poses may be those of something else on the body.
TEST_F(EurocTest, truth_of_a_sensor_is_moved_to_the_body) {
  const Trajectory before = *open_sequence(folder_).truth;
  const Rigid3 body_from_prism{rotation_exp({0.1, 0.2, 0.3}), {1, 2, 3}};
  put("mav0/state_groundtruth_estimate0/sensor.yaml", sensor_yaml(kLeft, body_from_prism));
  std::string truth;
  for (int i = 0; i < kFrames; ++i)
    truth += truth_line(stamp(i), world_from_left_at(i) * kBodyFromLeft.inverse() * body_from_prism);
  put("mav0/state_groundtruth_estimate0/data.csv", truth);
  const Trajectory after = *open_sequence(folder_).truth;
  ASSERT_EQ(std::ssize(before), kFrames);
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_LT(left_perturbation(before[i].world_from_camera, after[i].world_from_camera).norm(), 1e-9);
  }
}

TEST_F(EurocTest, a_calibration_of_its_own_goes_first) {
  put("camera.yaml",
      "camera: {width: 120, height: 80, fx: 100, fy: 100, cx: 60, cy: 40}\nright: {baseline: 0.2}\n");
  const Sequence sequence = open_sequence(folder_);
  EXPECT_FALSE(sequence.calibration.raw_stereo);
  EXPECT_EQ(*sequence.calibration.baseline, 0.2);
  EXPECT_EQ(FrameLoader(sequence).load(FrameId{0}).gray, read_gray(sequence.frames[0].color));
}

TEST_F(EurocTest, written_calibration_is_read_again) {
  const Calibration calibration = open_sequence(folder_).calibration;
  const Calibration again = read_calibration(write("again.yaml", format_calibration(calibration)));
  EXPECT_EQ(format_calibration(again), format_calibration(calibration));
  EXPECT_EQ(again.camera.fx, calibration.camera.fx);
  EXPECT_EQ(again.camera.cx, calibration.camera.cx);
  EXPECT_EQ(again.baseline, calibration.baseline);
}

TEST_F(EurocTest, cameras_that_make_no_pair_are_refused) {
  const auto with_right = [&](const Rigid3& left_from_right) {
    put("mav0/cam1/sensor.yaml", sensor_yaml(kRight, kBodyFromLeft * left_from_right));
    return refusal();
  };
  const std::string file = (folder_ / "mav0/cam1/sensor.yaml").string();
  EXPECT_TRUE(
      with_right({}).starts_with(file + ": expected two cameras that are apart, found the right one"));
  EXPECT_TRUE(with_right(kLeftFromRight.inverse())
                  .starts_with(file + ": expected the right camera to the right of the left one"));
  EXPECT_TRUE(with_right({rotation_exp({0, 3, 0}), {0.1, 0, 0}})
                  .starts_with(file +
                               ": expected two cameras beside each other that look the same way, found "
                               "no view in common"));
}

TEST_F(EurocTest, images_of_another_size_are_refused) {
  put_gray(fmt::format("mav0/cam1/data/{}.png", stamp(0)), GrayImage(60, 40));
  const Sequence sequence = open_sequence(folder_);
  EXPECT_NE(message_of([&] {
              return FrameLoader(sequence).load(FrameId{0});
            }).find("an image of 120x80 pixels, as the calibration says, found 60x40"),
            std::string::npos);
}

TEST_F(EurocTest, parameters_of_one_camera_are_refused) {
  SequenceOptions options;
  options.camera_parameters.fx = 100;
  EXPECT_NE(message_of([&] { return open_sequence(folder_, options); }).find("raw stereo pair"),
            std::string::npos);
}

class RawKittiTest : public EurocTest {};

/// Raw images in KITTI's folders, with both cameras in camera.yaml.
TEST_F(RawKittiTest, frames_and_truth_come_rectified) {
  const Sequence euroc = open_sequence(folder_);
  const FrameLoader euroc_loader(euroc);
  const fs::path mav = folder_ / "mav0", kitti = folder_ / "kitti";
  fs::create_directories(kitti / "image_0");
  fs::create_directories(kitti / "image_1");
  fs::copy_file(euroc.frames[0].color, kitti / "image_0/000000.png");
  fs::copy_file(euroc.frames[0].right, kitti / "image_1/000000.png");
  put("kitti/times.txt", "0.5\n");
  put("kitti/poses.txt", "1 0 0 7 0 1 0 8 0 0 1 9\n");
  put("kitti/camera.yaml", format_calibration(euroc.calibration));
  const Sequence sequence = open_sequence(kitti);
  EXPECT_EQ(sequence.format, "KITTI");
  EXPECT_EQ(FrameLoader(sequence).load(FrameId{0}).right, euroc_loader.load(FrameId{0}).right);
  const Rigid3& world_from_camera = sequence.truth->front().world_from_camera;
  EXPECT_EQ(world_from_camera.translation, Eigen::Vector3d(7, 8, 9));
  EXPECT_LT(rotation_angle(world_from_camera.rotation *
                           sequence.calibration.raw_stereo->rectification.rectified_from_left),
            1e-7);
}

class AslSensorTest : public EurocTest {
 protected:
  [[nodiscard]] std::string message_with(const std::string& old, const std::string& by) const {
    replace("mav0/cam0/sensor.yaml", old, by);
    std::string message = refusal();
    put("mav0/cam0/sensor.yaml", sensor_yaml(kLeft, kBodyFromLeft));
    return message.substr(message.find("sensor.yaml"));
  }
};

TEST_F(AslSensorTest, what_is_wrong_is_named_with_its_line) {
  EXPECT_TRUE(message_with("camera_model: pinhole", "camera_model: omni")
                  .starts_with("sensor.yaml:8: expected pinhole for 'camera_model', found 'omni'"));
  EXPECT_TRUE(message_with("radial-tangential", "fov")
                  .starts_with("sensor.yaml:10: expected radial-tangential, equidistant or none for"));
  EXPECT_TRUE(message_with("[120, 80]", "[120, 80.5]").starts_with("sensor.yaml:7: expected whole numbers"));
  EXPECT_TRUE(message_with("[90,", "[0,").starts_with("sensor.yaml:9: expected focal lengths above 0"));
  EXPECT_TRUE(message_with("0.07,", "").starts_with("sensor.yaml:11: expected a list of numbers"));
  EXPECT_TRUE(message_with("0.07,", ".nan,").starts_with("sensor.yaml:11: expected finite numbers"));
  EXPECT_TRUE(message_with("T_BS", "T_SB").starts_with("sensor.yaml:2: expected 'T_BS' in 'sensor'"));
  EXPECT_TRUE(message_with("data: [", "data: [9, ").starts_with("sensor.yaml:6: expected 16 numbers"));
  EXPECT_TRUE(message_with("0.0, 1.0]", "1.0, 0.0]").starts_with("sensor.yaml:6: expected a last row"));
  EXPECT_TRUE(message_with("data: [", "data: [-").starts_with("sensor.yaml:6: expected a rotation"));
}

TEST_F(AslSensorTest, lenses_without_distortion_are_pinholes) {
  replace("mav0/cam0/sensor.yaml", "radial-tangential", "none");
  EXPECT_EQ(read_asl_camera(folder_ / "mav0/cam0/sensor.yaml").model, CameraModel::pinhole);
}

}  // namespace
}  // namespace cairn
