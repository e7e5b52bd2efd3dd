// SPDX-License-Identifier: Apache-2.0
// Files as surveyors' programs and receivers write them: the poses are those of the plain table.
#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <numbers>

#include "cairn/sequence/given_poses.h"
#include "cairn/sequence/gps_time.h"
#include "cairn/sequence/sequence.h"
#include "cairn/testing/core/message_of.h"
#include "cairn/testing/image/recording_folder.h"
#include "cairn/testing/sequence/listed_frames.h"

namespace cairn {
namespace {

using testkit::forward_camera_on_frd;
using testkit::message_of;
using testkit::RecordingFolder;
using testkit::sequence_of;

constexpr double kDegree = std::numbers::pi / 180;
/// GPS week 2209, second 490782, less 18 leap seconds: 13 May 2022, 16:19:24 UTC.
constexpr std::int64_t kStampNs = 1'652'458'764'000'000'000;

/// The example of NovAtel's reference, with its checksum.
constexpr const char* kExtendedLog =
    "#INSPVAXA,USB1,0,65.5,FINESTEERING,2209,490782.000,02000020,46eb,16809;INS_SOLUTION_GOOD,INS_PPP,"
    "51.15043710672,-114.03067871892,1097.3598,-17.0001,-0.0016,0.0002,0.0029,-0.308665944,0.297893298,"
    "157.960833016,0.1816,0.1816,0.1808,0.0018,0.0018,0.0016,0.0292,0.0292,0.0582,13000045,0*a74644a2\r\n";
constexpr const char* kPlainNames =
    "time_s,latitude_deg,longitude_deg,height_m,roll_deg,pitch_deg,heading_deg,std_east_m,std_north_m,std_up_"
    "m,"
    "std_roll_deg,std_pitch_deg,std_heading_deg\n";

class SurveyorsPosesTest : public testing::Test, protected RecordingFolder {
 protected:
  [[nodiscard]] GivenPoses read(const std::string& name, const std::string& text,
                                std::int64_t first_ns = kStampNs) const {
    Sequence sequence = sequence_of("TUM", {0, 1, 2}, 10);
    for (FrameFiles& files : sequence.frames) files.stamp_ns += first_ns;
    sequence.calibration.body_from_camera = forward_camera_on_frd();
    GivenPosesOptions options;
    options.path = write(name, text);
    return read_given_poses(sequence, options);
  }
  static void expect_same(const GivenPoses& found, const GivenPoses& expected, std::size_t frame) {
    ASSERT_TRUE(found.frames.at(frame));
    ASSERT_TRUE(expected.frames.at(frame));
    const GivenPose &a = *found.frames[frame], &b = *expected.frames[frame];
    EXPECT_LT(left_perturbation(a.world_from_camera, b.world_from_camera).norm(), 1e-9);
    EXPECT_NEAR(found.origin->latitude_deg, expected.origin->latitude_deg, 1e-12);
    EXPECT_NEAR(found.origin->longitude_deg, expected.origin->longitude_deg, 1e-12);
    EXPECT_NEAR(found.origin->height_m, expected.origin->height_m, 1e-6);
    ASSERT_EQ(a.uncertainty.has_value(), b.uncertainty.has_value());
    if (!a.uncertainty) return;
    EXPECT_LT((a.uncertainty->position - b.uncertainty->position).norm(), 1e-12);
    EXPECT_LT((a.uncertainty->rotation - b.uncertainty->rotation).norm(), 1e-12);
  }
};

/// The height is above mean sea level and the undulation is added; deviations are of north, east, up.
TEST_F(SurveyorsPosesTest, extended_logs_of_novatel_are_read) {
  const GivenPoses expected =
      read("plain.csv", std::string(kPlainNames) +
                            "1652458764,51.15043710672,-114.03067871892,1080.3597,-0.308665944,0.297893298,"
                            "157.960833016,0.1816,0.1816,0.1808,0.0292,0.0292,0.0582\n");
  const GivenPoses found =
      read("span.log", std::string("#BESTPOSA,USB1,0,65.5;SOL_COMPUTED*00000000\n") + kExtendedLog);
  EXPECT_EQ(found.format, "NovAtel");
  expect_same(found, expected, 0);
  ASSERT_FALSE(found.warnings.empty());
  EXPECT_NE(found.warnings.front().find("18 leap seconds"), std::string::npos);
}

/// INSPVAA and INSPVASA have the height above the ellipsoid. Logs from before a solution are left out.
TEST_F(SurveyorsPosesTest, logs_without_deviations_are_read) {
  constexpr std::int64_t kEarlierNs = kStampNs - 70'000'000'000;
  const GivenPoses expected = read("plain.csv",
                                   "time_s,latitude,longitude,height,roll,pitch,heading\n1652458694,51."
                                   "15043713712,-114.03067872932,1080.3580,"
                                   "-0.293782412,0.302470613,157.989827209\n",
                                   kEarlierNs);
  for (const char* text :
       {"%INSPVASA,2209,490712.000;2209,490712.000000000,51.15043713712,-114.03067872932,1080.3580,0.0014,-0."
        "0007,0.0015,-0.293782412,0.302470613,157.989827209,INS_SOLUTION_GOOD*a87ab88b\n",
        "#INSPVAA,COM1,0,65.5,FINESTEERING,2209,490711.900,02000020,18bc,16809;2209,490711.900000000,51."
        "15043713712,-114.03067872932,1080.3580,0.0014,-0.0007,0.0015,0.0,0.0,0.0,INS_ALIGNING*506ccd56\n#"
        "INSPVAA,COM1,0,65.5,FINESTEERING,2209,490712.000,02000020,18bc,16809;2209,490712.000000000,51."
        "15043713712,-114.03067872932,1080.3580,0.0014,-0.0007,0.0015,-0.293782412,0.302470613,157.989827209,"
        "INS_SOLUTION_GOOD*6c5c2132\n"}) {
    const GivenPoses found = read("span.log", text, kEarlierNs);
    expect_same(found, expected, 0);
    EXPECT_EQ(found.without_pose, 2U);
  }
}

TEST_F(SurveyorsPosesTest, a_damaged_log_is_an_error) {
  std::string log = kExtendedLog;
  log.replace(log.find("51.15"), 5, "51.16");
  EXPECT_NE(message_of([&] { return read("span.log", log); }).find("span.log:1: expected the checksum"),
            std::string::npos);
}

/// Semicolons, tabs, quotes, decimal commas, lines before the names, units in the names, other names.
TEST_F(SurveyorsPosesTest, tables_of_spreadsheets_and_programs_are_read) {
  const std::string plain = std::string(kPlainNames) +
                            "1652458764,51.15043710672,-114.03067871892,1080.3597,-0.308665944,0.297893298,"
                            "157.960833016,0.19,0.18,0.17,0.0292,0.0291,0.0582\n";
  const GivenPoses expected = read("plain.csv", plain);
  for (const char* text :
       {"Project: street, north\nExported: today\n\n"
        "GPS Week;Seconds of Week (s);Latitude (deg);Longitude (deg);Altitude (m);Roll (deg);Pitch (deg);"
        "Azimuth (deg);East Std Dev (m);North Std Dev (m);Up Std Dev (m);Roll Std Dev (deg);"
        "Pitch Std Dev (deg);Heading Std Dev (deg);East Velocity Std Dev (m/s)\r\n"
        "2209;490782,0;51,15043710672;-114,03067871892;1080,3597;-0,308665944;0,297893298;157,960833016;"
        "0,19;0,18;0,17;0,0292;0,0291;0,0582;0,01\r\n",
        "Week\tTime of Week\tLatitude\tLongitude\tH-Ell\tRoll\tPitch\tYaw\tSD Easting\tSD Northing\t"
        "SD Height (mm)\tSD Roll\tSD Pitch\tSD Heading\n"
        "2209\t490782.0\t51.15043710672\t-114.03067871892\t1080.3597\t-0.308665944\t0.297893298\t"
        "157.960833016\t0.19\t0.18\t170\t0.0292\t0.0291\t0.0582\n",
        "\"time\",\"lat\",\"lon\",\"elevation (m)\",\"roll\",\"pitch\",\"heading\",\"sde(cm)\",\"sdn(cm)\","
        "\"sdu(cm)\",\"sigma roll\",\"sigma pitch\",\"sigma heading\"\n"
        "\"1652458764\",\"51,15043710672\",\"-114,03067871892\",\"1080,3597\",\"-0,308665944\",\"0,"
        "297893298\","
        "\"157,960833016\",\"19\",\"18\",\"17\",\"0,0292\",\"0,0291\",\"0,0582\"\n"}) {
    SCOPED_TRACE(text);
    expect_same(read("table.csv", text), expected, 0);
  }
}

/// In a local world yaw may be counted from x or from y.
TEST_F(SurveyorsPosesTest, yaw_is_a_heading_on_the_earth_alone) {
  const std::string row = "1652458764,49,8,100,1,2,3\n";
  const GivenPoses found = read("t.csv", "time,lat,lon,alt,roll,pitch,yaw\n" + row);
  expect_same(found, read("p.csv", "time,lat,lon,alt,roll,pitch,heading\n" + row), 0);
  ASSERT_FALSE(found.warnings.empty());
  EXPECT_NE(found.warnings.front().find("yaw is taken as the heading"), std::string::npos);
  const auto local = [&] { return read("t.csv", "time,east,north,up,roll,pitch,yaw\n" + row); };
  EXPECT_NE(message_of(local).find("'heading' among the columns"), std::string::npos);
}

std::string sbet_record(double time_s, double heading_deg, double wander_deg) {
  const std::array<double, 17> record{time_s,
                                      49 * kDegree,
                                      8 * kDegree,
                                      112.5,
                                      1,
                                      2,
                                      3,
                                      1 * kDegree,
                                      -2 * kDegree,
                                      heading_deg * kDegree,
                                      wander_deg * kDegree,
                                      0,
                                      0,
                                      0,
                                      0,
                                      0,
                                      0};
  std::string bytes(sizeof record, '\0');
  std::memcpy(bytes.data(), record.data(), sizeof record);
  return bytes;
}

/// The true heading is the stated one less the wander angle.
TEST_F(SurveyorsPosesTest, binary_sbet_is_read) {
  constexpr std::int64_t kSecondOfWeekNs = 235'409'000'000'000;
  const GivenPoses expected = read("plain.csv",
                                   "time_s,latitude,longitude,height,roll,pitch,heading\n"
                                   "235409,49,8,112.5,1,-2,30\n235409.1,49,8,112.5,1,-2,35\n",
                                   kSecondOfWeekNs);
  const GivenPoses found =
      read("sbet.out", sbet_record(235409, 31.5, 1.5) + sbet_record(235409.1, 33, -2), kSecondOfWeekNs);
  EXPECT_EQ(found.format, "SBET");
  expect_same(found, expected, 0);
  expect_same(found, expected, 1);
}

TEST_F(SurveyorsPosesTest, sbet_times_increase) {
  const std::string bytes = sbet_record(2, 0, 0) + sbet_record(1, 0, 0);
  EXPECT_NE(message_of([&] { return read("sbet.out", bytes); }).find("1 s in record 2"), std::string::npos);
}

TEST(GpsTime, leap_seconds_hold_from_their_day_on) {
  constexpr std::int64_t kSecondNs = 1'000'000'000;
  // 2016-12-31 23:59:59 UTC and 2017-01-01 00:00:00 UTC: week 1930, seconds 16 and 18
  EXPECT_EQ(utc_from_gps(1930, 16 * kSecondNs), 1'483'228'799 * kSecondNs);
  EXPECT_EQ(utc_from_gps(1930, 18 * kSecondNs), 1'483'228'800 * kSecondNs);
  EXPECT_EQ(utc_from_gps(0, 0), 315'964'800 * kSecondNs);
}

}  // namespace
}  // namespace cairn
