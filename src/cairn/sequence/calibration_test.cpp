// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/calibration.h"

#include <gtest/gtest.h>

#include "cairn/core/file.h"
#include "cairn/testing/core/message_of.h"
#include "cairn/testing/image/recording_folder.h"

namespace cairn {
namespace {

using testkit::message_of;
using testkit::RecordingFolder;

constexpr const char* kWhole = R"(# RedKitchen
camera: {model: pinhole, width: 640, height: 480, fx: 525.0, fy: 526.0, cx: 320.0, cy: 240.0, distortion: []}
right:  {baseline: 0.537}
depth:
  scale: 1000.0           # units per metre
  invalid: [0, 65535]
  camera: {model: pinhole, width: 320, height: 240, fx: 585.0, fy: 585.0, cx: 160.0, cy: 120.0}
  camera_from_depth: {translation: [-0.02, 0, 0.01], quaternion_xyzw: [0, 0, 0.6, 0.8]}
poses_are: depth
rate_hz: 15
)";
constexpr const char* kCamera = "camera: {width: 8, height: 6, fx: 10, fy: 10, cx: 4, cy: 3}\n";

class CalibrationTest : public testing::Test, protected RecordingFolder {
 protected:
  [[nodiscard]] Calibration read(const std::string& text) const {
    return read_calibration(write("camera.yaml", text));
  }
};

TEST_F(CalibrationTest, reads_all_that_there_is) {
  const Calibration read_back = read(kWhole);
  EXPECT_EQ(read_back.camera.model, CameraModel::pinhole);
  EXPECT_EQ(read_back.camera.width, 640);
  EXPECT_EQ(read_back.camera.fy, 526);
  EXPECT_EQ(read_back.baseline, 0.537);
  ASSERT_TRUE(read_back.depth);
  EXPECT_EQ(read_back.depth->scale, 1000);
  EXPECT_EQ(read_back.depth->invalid, (std::vector<std::uint16_t>{0, 65535}));
  ASSERT_TRUE(read_back.depth->camera);
  EXPECT_EQ(read_back.depth->camera->height, 240);
  EXPECT_EQ(read_back.depth->camera_from_depth.translation, Eigen::Vector3d(-0.02, 0, 0.01));
  EXPECT_DOUBLE_EQ(read_back.depth->camera_from_depth.rotation.z(), 0.6);
  EXPECT_EQ(read_back.poses_are, PosesAre::depth);
  EXPECT_EQ(read_back.rate_hz, 15);
}

TEST_F(CalibrationTest, reads_the_correction_of_the_right_camera) {
  const std::string camera = kCamera;
  const Calibration whole = read(
      camera + "right: {baseline: 1, correction: {rows: [1, 2, 3, 4, 5, -6.5], disparity: [0.5, 0, -1]}}\n");
  ASSERT_TRUE(whole.right_correction);
  EXPECT_EQ(whole.right_correction->rows, (RowField() << 1, 2, 3, 4, 5, -6.5).finished());
  EXPECT_EQ(whole.right_correction->disparity, DisparityField(0.5, 0, -1));
  const Calibration part = read(camera + "right: {baseline: 1, correction: {disparity: [0.5, 0, -1]}}\n");
  ASSERT_TRUE(part.right_correction);
  EXPECT_TRUE(part.right_correction->rows.isZero(0));
  EXPECT_FALSE(read(camera + "right: {baseline: 1}\n").right_correction);
}

TEST_F(CalibrationTest, a_raw_pair_keeps_its_cameras_beside_the_correction) {
  Calibration raw = read(kCamera);
  const LeftFromRight left_from_right(Rigid3{rotation_exp({0.01, 0.02, -0.01}), {0.2, 0, 0.01}});
  set_raw_stereo({raw.camera, raw.camera, left_from_right}, {}, raw);
  raw.right_correction.emplace().rows << 0.1, 0, 0, -7, 0, 1.0 / 3.0;
  const Calibration back = read(format_calibration(raw));
  ASSERT_TRUE(back.raw_stereo && back.right_correction);
  EXPECT_EQ(back.raw_stereo->pair.left_from_right.translation, left_from_right.translation);
  EXPECT_EQ(back.baseline, raw.baseline);
  EXPECT_EQ(back.right_correction->rows, raw.right_correction->rows);
  EXPECT_TRUE(back.right_correction->disparity.isZero(0));
}

TEST_F(CalibrationTest, little_is_enough) {
  const Calibration read_back = read(kCamera);
  EXPECT_EQ(read_back.camera.model, CameraModel::pinhole);
  EXPECT_FALSE(read_back.baseline);
  EXPECT_FALSE(read_back.depth);
  EXPECT_EQ(read_back.poses_are, PosesAre::camera);
  EXPECT_FALSE(read_back.rate_hz);
  EXPECT_EQ(read_back.stamp_rate_hz(), 30);
}

TEST_F(CalibrationTest, reads_distorted_cameras) {
  const auto distorted = [&](const std::string& model, const std::string& values) {
    return read("camera: {model: " + model +
                ", width: 8, height: 6, fx: 10, fy: 10, cx: 4, cy: 3, distortion: [" + values + "]}")
        .camera;
  };
  EXPECT_EQ(distorted("radtan", "1, 2, 3, 4").distortion, (std::array<double, 5>{1, 2, 3, 4, 0}));
  EXPECT_EQ(distorted("radtan", "1, 2, 3, 4, 5").distortion, (std::array<double, 5>{1, 2, 3, 4, 5}));
  EXPECT_EQ(distorted("kb4", "1, 2, 3, 4").model, CameraModel::kb4);
}

TEST_F(CalibrationTest, blocks_marks_and_windows_line_ends_do_not_matter) {
  const Calibration read_back = read(
      "\xEF\xBB\xBF"
      "camera:  \r\n  width: 8\r\n  height: 6\r\n  fx: 10\r\n  fy: 1.0e+1 \r\n  cx: 4\r\n  cy: 3\r\n");
  EXPECT_EQ(read_back.camera.fy, 10);
}

TEST_F(CalibrationTest, zero_is_always_invalid_depth) {
  EXPECT_EQ(read(kCamera + std::string("depth: {scale: 5, invalid: [65535]}")).depth->invalid,
            (std::vector<std::uint16_t>{0, 65535}));
  EXPECT_EQ(read(kCamera + std::string("depth: {scale: 5}")).depth->invalid, std::vector<std::uint16_t>{0});
}

struct Case {
  std::string text;
  int line;
  const char* rest;
};

/// The camera with one value replaced.
std::string with(const std::string& old_text, const std::string& new_text) {
  std::string text = kWhole;
  const std::size_t place = text.find(old_text);
  return place == std::string::npos ? "" : text.replace(place, old_text.size(), new_text);
}

void expect_refused(const std::filesystem::path& folder, const Case& broken) {
  write_file(folder / "camera.yaml", broken.text);
  std::string place = (folder / "camera.yaml").string();
  if (broken.line > 0) place.append(1, ':').append(std::to_string(broken.line));
  EXPECT_EQ(message_of([&] { return read_calibration(folder / "camera.yaml"); }), place + ": " + broken.rest)
      << broken.text;
}

TEST_F(CalibrationTest, wrong_structure_is_refused_by_line) {
  const Case cases[] = {
      {"", 0, "expected a calibration, found an empty file.\n  See the README, \"Calibration\"."},
      {"# nothing\n", 0, "expected a calibration, found an empty file.\n  See the README, \"Calibration\"."},
      {"hello", 1,
       "expected a mapping for 'calibration', found 'hello'.\n  See the README, \"Calibration\"."},
      {"- 1\n- 2\n", 1,
       "expected a mapping for 'calibration', found a list of 2.\n  See the README, \"Calibration\"."},
      {"camera: [1, 2", 1, "expected YAML, found end of sequence flow not found.\n  Correct the line."},
      {"rate_hz: 3\n", 1,
       "expected 'camera' in 'calibration' (the colour or left camera), found none.\n  Add 'camera'."},
      {"\ncamera: 5\n", 2, "expected a mapping for 'camera', found '5'.\n  See the README, \"Calibration\"."},
      {with("fx:", "fxx:"), 2, "expected a known key in 'camera', found 'fxx'.\n  Did you mean 'fx'?"},
      {with("right:", "rihgt:"), 3,
       "expected a known key in 'calibration', found 'rihgt'.\n  Did you mean 'right'?"},
      {with("  scale:", "  scal:"), 5,
       "expected a known key in 'depth', found 'scal'.\n  Did you mean 'scale'?"},
      {with("  scale: 1000.0", ""), 6, "expected 'scale' in 'depth' (a number), found none.\n  Add 'scale'."},
      {with("fx: 525.0, ", ""), 2, "expected 'fx' in 'camera' (a number), found none.\n  Add 'fx'."},
      {with("cy: 240.0,", "cy: 240.0, cy: 3,"), 2,
       "expected one 'cy' in 'camera', found two.\n  Delete one."},
      {with("rate_hz:", "? [a]\n:"), 10,
       "expected a known key in 'calibration', found 'a list or mapping'.\n"
       "  Known are camera, right, depth, body, poses_are, rate_hz."},
  };
  for (const Case& broken : cases) expect_refused(folder_, broken);
}

TEST_F(CalibrationTest, wrong_values_are_refused_by_line) {
  const Case cases[] = {
      {with("fx: 525.0", "fx: 0"), 2, "expected a number above 0 for 'fx', found '0'.\n  Correct the value."},
      {with("fy: 526.0", "fy: -1"), 2,
       "expected a number above 0 for 'fy', found '-1'.\n  Correct the value."},
      {with("cx: 320.0", "cx: .nan"), 2,
       "expected a finite number for 'cx', found '.nan'.\n  Correct the value."},
      {with("cx: 320.0", "cx: wide"), 2, "expected a number for 'cx', found 'wide'.\n  Correct the value."},
      {with("cx: 320.0", "cx: [1]"), 2,
       "expected a number for 'cx', found a list of 1.\n  Correct the value."},
      {with("640", "640.5"), 2,
       "expected a whole number of pixels for 'width', found '640.5'.\n  Correct the value."},
      {with("480", "0"), 2, "expected from 1 to 32768 pixels for 'height', found '0'.\n  Correct the value."},
      {with("480", "99999"), 2,
       "expected from 1 to 32768 pixels for 'height', found '99999'.\n  Correct the value."},
      {with("pinhole", "fisheye"), 2,
       "expected pinhole, radtan or kb4 for 'model', found 'fisheye'.\n  Correct the value."},
      {with("0.537", "-0.5"), 3,
       "expected a number above 0 for 'baseline', found '-0.5'.\n  Correct the value."},
      {with("1000.0", "0"), 5, "expected a number above 0 for 'scale', found '0'.\n  Correct the value."},
      {with("1000.0", ".inf"), 5,
       "expected a finite number for 'scale', found '.inf'.\n  Correct the value."},
      {with("65535", "65536"), 6,
       "expected raw depths from 0 to 65535 for 'invalid', found a list of 2.\n  Correct the value."},
      {with("[0, 65535]", "0"), 6,
       "expected a list of raw depths for 'invalid', found '0'.\n  Correct the value."},
      {with("poses_are: depth", "poses_are: left"), 9,
       "expected camera or depth for 'poses_are', found 'left'.\n  Correct the value."},
      {std::string(kCamera) + "poses_are: depth", 2,
       "expected camera, as there is no 'depth', for 'poses_are', found 'depth'.\n  Correct the value."},
      {with("rate_hz: 15", "rate_hz: 0"), 10,
       "expected a number above 0 for 'rate_hz', found '0'.\n  Correct the value."},
      {with("rate_hz: 15", "rate_hz: 1e9"), 10,
       "expected at most a million frames per second for 'rate_hz', found '1e9'.\n  Correct the value."},
  };
  for (const Case& broken : cases) expect_refused(folder_, broken);
}

TEST_F(CalibrationTest, wrong_lists_are_refused_by_line) {
  const Case cases[] = {
      {with("distortion: []", "distortion: [0.1]"), 2,
       "expected an empty list (a pinhole has none; say model: radtan) for 'distortion', found a list of "
       "1.\n  Correct the value."},
      {with("model: pinhole", "model: radtan"), 2,
       "expected 4 or 5 numbers k1 k2 p1 p2 [k3] for 'distortion', found a list of 0.\n  Correct the value."},
      {with("model: pinhole", "model: kb4"), 2,
       "expected 4 numbers k1 k2 k3 k4 for 'distortion', found a list of 0.\n  Correct the value."},
      {"camera: {model: kb4, width: 8, height: 6, fx: 1, fy: 1, cx: 1, cy: 1, distortion: [0, .nan, 0, 0]}",
       1, "expected finite numbers for 'distortion', found a list of 4.\n  Correct the value."},
      {"camera: {model: kb4, width: 8, height: 6, fx: 1, fy: 1, cx: 1, cy: 1}", 1,
       "expected 'distortion' beside radtan or kb4 for 'model', found 'kb4'.\n  Correct the value."},
      {with("0.6, 0.8]", "0.6, 0.9]"), 8,
       "expected a quaternion of length 1 for 'quaternion_xyzw', found a list of 4.\n  Correct the value."},
      {with("0, 0, 0.6, 0.8]", "0, 0, 0, 0]"), 8,
       "expected a quaternion of length 1 for 'quaternion_xyzw', found a list of 4.\n  Correct the value."},
      {with("0, 0, 0.6, 0.8]", "0.6, 0.8]"), 8,
       "expected four numbers for 'quaternion_xyzw', found a list of 2.\n  Correct the value."},
      {with("[0, 0, 0.6, 0.8]", "one"), 8,
       "expected four numbers for 'quaternion_xyzw', found 'one'.\n  Correct the value."},
      {with("[-0.02, 0, 0.01]", "[1, 2]"), 8,
       "expected three numbers, metres for 'translation', found a list of 2.\n  Correct the value."},
      {with("[-0.02, 0, 0.01]", "[1, 2, .nan]"), 8,
       "expected finite numbers for 'translation', found a list of 3.\n  Correct the value."},
      {with("translation: [-0.02, 0, 0.01], ", ""), 8,
       "expected 'translation' in 'camera_from_depth' (three numbers, metres), found none.\n  Add "
       "'translation'."},
      {std::string(kCamera) + "right: {baseline: 1, correction: {rows: [1, 2]}}", 2,
       "expected six numbers, pixels for 'rows', found a list of 2.\n  Correct the value."},
      {std::string(kCamera) + "right: {baseline: 1, correction: {disparity: [1, 2, .nan]}}", 2,
       "expected finite numbers for 'disparity', found a list of 3.\n  Correct the value."},
      {std::string(kCamera) + "right: {baseline: 1, correction: {disparity: [1, 2, 1e4]}}", 2,
       "expected terms of at most 1000 pixels for 'disparity', found a list of 3.\n  Correct the value."},
      {std::string(kCamera) + "right: {baseline: 1, correction: {columns: [1]}}", 2,
       "expected a known key in 'correction', found 'columns'.\n  Known are rows, disparity."},
      {std::string(kCamera) + "right: {correction: {rows: [0, 0, 0, 0, 0, 0]}}", 2,
       "expected 'baseline' in 'right' (a number), found none.\n  Add 'baseline'."},
      {std::string(kCamera) + "body: {lever: 1}", 2,
       "expected a known key in 'body', found 'lever'.\n  Known are body_from_camera."},
      {std::string(kCamera) + "body: {}", 2,
       "expected 'body_from_camera' in 'body' (where the camera sits on the body), found none.\n  Add "
       "'body_from_camera'."},
      {std::string(kCamera) + "body: {body_from_camera: {translation: [0, 0, 0]}}", 2,
       "expected 'quaternion_xyzw' in 'body_from_camera' (four numbers), found none.\n  Add "
       "'quaternion_xyzw'."},
  };
  for (const Case& broken : cases) expect_refused(folder_, broken);
}

void expect_same(const Camera& a, const Camera& b) {
  EXPECT_EQ(a.model, b.model);
  EXPECT_EQ(std::tie(a.width, a.height, a.fx, a.fy, a.cx, a.cy, a.distortion),
            std::tie(b.width, b.height, b.fx, b.fy, b.cx, b.cy, b.distortion));
}

TEST_F(CalibrationTest, format_is_read_back) {
  Calibration calibrations[] = {read(kWhole), read(kCamera), *known_calibration("tum-fr1")};
  calibrations[1].camera.model = CameraModel::kb4;
  calibrations[1].camera.distortion = {1.0 / 3.0, 1e-17, -2, 0, 0};
  calibrations[1].depth =
      DepthCalibration{1.0 / 7.0, {0, 9}, std::nullopt, {rotation_exp({1, 2, 3}), {4, 5, 6}}};
  calibrations[0].right_correction = {(RowField() << 1.0 / 3.0, -2, 3e-9, 4, 5, 6).finished(),
                                      {1.0 / 7.0, -0.25, 1e-17}};
  calibrations[2].body_from_camera = Rigid3{rotation_exp({0.3, -1, 2}), {1.5, 1.0 / 3.0, -0.2}};
  for (const Calibration& calibration : calibrations) {
    const Calibration back = read(format_calibration(calibration));
    expect_same(back.camera, calibration.camera);
    EXPECT_EQ(back.baseline, calibration.baseline);
    EXPECT_EQ(back.poses_are, calibration.poses_are);
    EXPECT_EQ(back.rate_hz, calibration.rate_hz);
    ASSERT_EQ(back.right_correction.has_value(), calibration.right_correction.has_value());
    if (back.right_correction) {
      EXPECT_EQ(back.right_correction->rows, calibration.right_correction->rows);
      EXPECT_EQ(back.right_correction->disparity, calibration.right_correction->disparity);
    }
    ASSERT_EQ(back.body_from_camera.has_value(), calibration.body_from_camera.has_value());
    if (back.body_from_camera) {
      EXPECT_EQ(back.body_from_camera->translation, calibration.body_from_camera->translation);
      EXPECT_EQ(back.body_from_camera->rotation.coeffs(), calibration.body_from_camera->rotation.coeffs());
    }
    ASSERT_EQ(back.depth.has_value(), calibration.depth.has_value());
    if (!back.depth) continue;
    EXPECT_EQ(back.depth->scale, calibration.depth->scale);
    EXPECT_EQ(back.depth->invalid, calibration.depth->invalid);
    ASSERT_EQ(back.depth->camera.has_value(), calibration.depth->camera.has_value());
    if (back.depth->camera) expect_same(*back.depth->camera, *calibration.depth->camera);
    const Rigid3 difference = back.depth->camera_from_depth.inverse() * calibration.depth->camera_from_depth;
    EXPECT_LT(motion_norm(difference), 1e-14);
  }
}

TEST(KnownCalibration, knows_the_tum_benchmark) {
  EXPECT_EQ(known_calibration("tum-fr1")->camera.model, CameraModel::radtan);
  EXPECT_EQ(known_calibration("tum-fr2")->camera.fx, 520.9);
  EXPECT_EQ(known_calibration("tum-fr3")->camera.model, CameraModel::pinhole);
  EXPECT_EQ(known_calibration("tum-fr3")->depth->scale, 5000);
  EXPECT_FALSE(known_calibration("tum-fr4"));
}

}  // namespace
}  // namespace cairn
