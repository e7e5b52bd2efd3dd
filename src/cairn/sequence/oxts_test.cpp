// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cairn/core/error.h"
#include "cairn/sequence/given_poses.h"
#include "cairn/sequence/sequence.h"
#include "cairn/testing/core/message_of.h"
#include "cairn/testing/image/recording_folder.h"
#include "cairn/testing/sequence/listed_frames.h"

namespace cairn {
namespace {

using testkit::earth_centred;
using testkit::earth_from_enu;
using testkit::forward_camera_on_flu;
using testkit::message_of;
using testkit::RecordingFolder;
using testkit::sequence_of;

namespace fs = std::filesystem;

constexpr const char* kTimes =
    "2011-09-26 13:02:25.594360375\n2011-09-26 13:02:25.694360375\n2011-09-26 13:02:25.794360375\n";
constexpr std::int64_t kFirstNs = 1'317'042'145'594'360'375;  // date -u -d '2011-09-26 13:02:25' +%s

/// lat lon alt roll pitch yaw, velocities, accelerations, rates, pos_accuracy, vel_accuracy, status.
std::string packet(double latitude_deg, double longitude_deg, double height_m, const std::string& angles,
                   double accuracy = 0.05) {
  return fmt::format("{} {} {} {} 0 0 0 0 0 0 0 9.8 0 0 9.8 0 0 0 0 0 0 {} 0.02 4 11 6 6 6\n", latitude_deg,
                     longitude_deg, height_m, angles, accuracy);
}

class OxtsTest : public testing::Test, protected RecordingFolder {
 protected:
  OxtsTest() { make_good(); }
  void make_good() const {
    put("oxts/timestamps.txt", kTimes);
    put("oxts/data/0000000000.txt", packet(49.011, 8.42, 112.0, "0 0 0"));
    put("oxts/data/0000000001.txt", packet(49.012, 8.43, 115.0, "0.02 -0.03 2.5"));
    put("oxts/data/0000000002.txt", packet(49.011, 8.42, 114.0, "0 0 1.5707963267948966", 0.1));
  }
  static Sequence sequence() {
    Sequence frames = sequence_of("KITTI", {0, 1, 2}, 10);
    for (FrameFiles& files : frames.frames) files.stamp_ns += kFirstNs;
    frames.calibration.body_from_camera = forward_camera_on_flu();
    return frames;
  }
  [[nodiscard]] GivenPosesOptions given() const {
    GivenPosesOptions options;
    options.path = folder_ / "oxts";
    return options;
  }
};

TEST_F(OxtsTest, the_first_pose_used_is_the_origin) {
  const GivenPoses poses = read_given_poses(sequence(), given());
  EXPECT_EQ(poses.format, "OXTS");
  EXPECT_EQ(poses.origin->latitude_deg, 49.011);
  EXPECT_EQ(poses.origin->longitude_deg, 8.42);
  EXPECT_EQ(poses.origin->height_m, 112.0);
  // the body at the origin looks east, the camera sits 2 m ahead, 0.5 m right, 1 m up
  const WorldFromCamera& first = poses.frames[0]->world_from_camera;
  EXPECT_LT((first.translation - Eigen::Vector3d(2, -0.5, 1)).norm(), 1e-9);
  EXPECT_LT((first.rotation * Eigen::Vector3d::UnitZ() - Eigen::Vector3d::UnitX()).norm(), 1e-12);  // ahead
  EXPECT_LT((first.rotation * Eigen::Vector3d::UnitY() + Eigen::Vector3d::UnitZ()).norm(), 1e-12);  // down
  // yaw a quarter turn counter-clockwise: north
  const WorldFromCamera& last = poses.frames[2]->world_from_camera;
  EXPECT_LT((last.translation - Eigen::Vector3d(0.5, 2, 3)).norm(), 1e-9);
  EXPECT_LT((last.rotation * Eigen::Vector3d::UnitZ() - Eigen::Vector3d::UnitY()).norm(), 1e-12);
}

/// Roll is positive with the left side up, pitch with the front down, as KITTI's description of the data
/// says.
TEST_F(OxtsTest, signs_of_roll_and_pitch) {
  put("oxts/data/0000000000.txt", packet(49.011, 8.42, 112.0, "0.1 0 0"));
  put("oxts/data/0000000001.txt", packet(49.011, 8.42, 112.0, "0 0.1 0"));
  const GivenPoses poses = read_given_poses(sequence(), given());
  const Eigen::Vector3d left = poses.frames[0]->world_from_camera.rotation * -Eigen::Vector3d::UnitX();
  EXPECT_NEAR(left.z(), std::sin(0.1), 1e-12);
  const Eigen::Vector3d ahead = poses.frames[1]->world_from_camera.rotation * Eigen::Vector3d::UnitZ();
  EXPECT_NEAR(ahead.z(), -std::sin(0.1), 1e-12);
}

/// Against earth-centred coordinates by the closed formulas: places a kilometre and more apart, where the
/// directions of north and up differ.
TEST_F(OxtsTest, places_and_rotations_agree_through_the_earths_centre) {
  const GivenPoses poses = read_given_poses(sequence(), given());
  const Eigen::Matrix3d world_from_earth = earth_from_enu(49.011, 8.42).transpose();
  const Rigid3 body = poses.frames[1]->world_from_camera * forward_camera_on_flu().inverse();
  const Eigen::Vector3d place =
      world_from_earth * (earth_centred(49.012, 8.43, 115) - earth_centred(49.011, 8.42, 112));
  EXPECT_LT((body.translation - place).norm(), 1e-6);
  const auto about = [](double angle, const Eigen::Vector3d& axis) {
    return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
  };
  const Eigen::Matrix3d enu_from_body = about(2.5, Eigen::Vector3d::UnitZ()) *
                                        about(-0.03, Eigen::Vector3d::UnitY()) *
                                        about(0.02, Eigen::Vector3d::UnitX());
  const Eigen::Matrix3d rotation = world_from_earth * earth_from_enu(49.012, 8.43) * enu_from_body;
  EXPECT_LT((body.matrix3() - rotation).norm(), 1e-9);
}

TEST_F(OxtsTest, accuracy_is_the_standard_deviation_of_the_place) {
  Sequence frames = sequence();
  frames.frames[1].stamp_ns = frames.frames[2].stamp_ns - 50'000'000;  // half way between two packets
  const GivenPoses poses = read_given_poses(frames, given());
  const auto expect_variance = [&](std::size_t i, double variance) {
    const PoseUncertainty& uncertainty = poses.frames.at(i)->uncertainty.value();
    EXPECT_LT((uncertainty.position - variance * Eigen::Matrix3d::Identity()).norm(), 1e-12);
    EXPECT_EQ(uncertainty.rotation, Eigen::Matrix3d::Zero());  // a packet says nothing of it
  };
  expect_variance(0, 0.0025);
  expect_variance(1, (0.0025 + 0.01) / 2);
  expect_variance(2, 0.01);
}

TEST_F(OxtsTest, a_sequence_carries_them_and_the_world_may_be_given) {
  Sequence frames = sequence();
  frames.folder = folder_;
  frames.frames.erase(frames.frames.begin());
  GivenPosesOptions options;
  EXPECT_EQ(read_given_poses(frames, options).origin->latitude_deg, 49.012);
  options.origin = GeodeticOrigin{49.011, 8.42, 110};
  const GivenPoses poses = read_given_poses(frames, options);
  EXPECT_LT((poses.frames[1]->world_from_camera.translation - Eigen::Vector3d(0.5, 2, 5)).norm(), 1e-9);
}

struct BrokenPackets {
  const char* file;
  std::string contents;
  int line;
  const char *expected, *found;
};

TEST_F(OxtsTest, broken_packets_are_refused) {
  const char* const time = "a date and a time, 2011-09-26 13:02:25.594360375";
  const char* const second = "data/0000000001.txt";
  const BrokenPackets cases[] = {
      {"timestamps.txt", "2011-09-26 13:02:25\n", 0, "3 times, one for each packet in data/", "1"},
      {"timestamps.txt", "1\n2\n3\n", 1, "2 values (date time, 2011-09-26 13:02:25.594360375)", "1"},
      {"timestamps.txt", "2011-02-29 13:02:25\n\n\n2011-02-28 1:1:1\n2011-02-28 1:1:1\n", 1, time,
       "'2011-02-29 13:02:25'"},
      {"timestamps.txt", "2011-09-26 24:02:25\n2011-09-26 1:1:1\n2011-09-26 1:1:1\n", 1, time,
       "'2011-09-26 24:02:25'"},
      {"timestamps.txt", "26.09.2011 13:02:25\n2011-09-26 1:1:1\n2011-09-26 1:1:1\n", 1, time,
       "'26.09.2011 13:02:25'"},
      {"timestamps.txt", "2011-09-26 13:02:25\n2011-09-26 13:02:24.5\n2011-09-26 13:02:26\n", 2,
       "a time stamp after 1317042145.000000000", "1317042144.500000000"},
      {second, "", 0, "one line with 30 values", "0 lines"},
      {second, "1 2 3\n", 1, "30 values (lat lon alt roll pitch yaw ... pos_accuracy ... orimode)", "3"},
      {second, packet(91, 8, 0, "0 0 0"), 1, "lat from -90 to 90 degrees", "91"},
      {second, packet(49, -181, 0, "0 0 0"), 1, "lon from -180 to 360 degrees", "-181"},
      {second, packet(49, 8, 1e7, "0 0 0"), 1, "alt from -1e+06 to 1e+06 m", "1e+07"},
      {second, packet(49, 8, 0, "0 0 143.2"), 1, "yaw from -6.28319 to 6.28319 radians", "143.2"},
      {second, packet(49, 8, 0, "0 nan 0"), 1, "a number for pitch", "'nan'"},
      {second, packet(49, 8, 0, "0 0 0", -1), 1, "pos_accuracy from 0 to 1e+06 m", "-1"},
  };
  for (const BrokenPackets& broken : cases) {
    SCOPED_TRACE(broken.expected);
    make_good();
    put("oxts/" + std::string(broken.file), broken.contents);
    try {
      (void)read_given_poses(sequence(), given());
      ADD_FAILURE() << "was read";
    } catch (const InputError& error) {
      EXPECT_EQ(error.details().file, (folder_ / "oxts" / broken.file).string());
      EXPECT_EQ(error.details().line, broken.line);
      EXPECT_EQ(error.details().expected, broken.expected);
      EXPECT_EQ(error.details().found, broken.found);
      EXPECT_FALSE(error.details().remedy.empty());
    }
  }
}

TEST_F(OxtsTest, a_body_needs_lever_arm_and_boresight) {
  Sequence frames = sequence();
  frames.calibration.body_from_camera.reset();
  const std::string message = message_of([&] { return read_given_poses(frames, given()); });
  EXPECT_NE(message.find("as the poses (OXTS) are of a body, found none"), std::string::npos) << message;
  EXPECT_NE(message.find("quaternion_xyzw: [-0.5, 0.5, -0.5, 0.5]}} (body: x forward, y left, z up)"),
            std::string::npos)
      << message;
}

}  // namespace
}  // namespace cairn
