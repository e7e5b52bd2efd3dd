// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/given_poses.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cairn/sequence/sequence.h"
#include "cairn/testing/core/message_of.h"
#include "cairn/testing/image/recording_folder.h"
#include "cairn/testing/sequence/listed_frames.h"

namespace cairn {
namespace {

using testkit::message_of;
using testkit::RecordingFolder;
using testkit::sequence_of;

namespace fs = std::filesystem;

class GivenPosesTest : public testing::Test, protected RecordingFolder {
 protected:
  /// The x of each pose, -1 where there is none.
  static std::vector<double> xs(const Sequence& sequence, const GivenPosesOptions& options) {
    std::vector<double> result;
    for (const auto& pose : poses_of_frames(sequence, options))
      result.push_back(pose ? pose->translation.x() : -1);
    return result;
  }
  static GivenPosesOptions with(const fs::path& path, double max_gap_s = 0.15, double time_offset_s = 0) {
    GivenPosesOptions options;
    options.path = path;
    options.max_gap_s = max_gap_s;
    options.time_offset_s = time_offset_s;
    return options;
  }
  static void expect_xs(const Sequence& sequence, const GivenPosesOptions& options,
                        const std::vector<double>& expected) {
    const auto found = xs(sequence, options);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-9) << i;
  }
};

TEST_F(GivenPosesTest, frames_between_poses_are_interpolated) {
  const auto path = write("poses.txt", "0.01 10 0 0 0 0 0 1\n0.11 11 0 0 0 0 0 1\n0.25 12 0 0 0 0 0 1\n");
  for (const char* format : {"TUM", "7-Scenes", "KITTI"}) {
    const Sequence sequence = sequence_of(format, {0, 1, 2, 3}, 10);
    expect_xs(sequence, with(path), {-1, 10.9, 11 + 9.0 / 14, -1});
    expect_xs(sequence, with(path, 0.13), {-1, 10.9, -1, -1});
    EXPECT_EQ(read_given_poses(sequence, with(path, 0.13)).without_pose, 3U);
    EXPECT_EQ(read_given_poses(sequence, with(path)).format, "TUM");
    EXPECT_FALSE(read_given_poses(sequence, with(path)).origin);
  }
}

TEST_F(GivenPosesTest, a_frame_at_the_stamp_of_a_pose_gets_it_whatever_the_gaps) {
  const auto path = write("poses.txt", "0 10 0 0 0.6 0 0 0.8\n100 11 0 0 0 0 0 1\n200.0009 12 0 0 0 0 0 1\n");
  const Sequence sequence = sequence_of("TUM", {0, 50, 100, 200}, 1);
  expect_xs(sequence, with(path), {10, -1, 11, 12});  // the last one's stamp is rounded
  EXPECT_EQ(poses_of_frames(sequence, with(path))[0]->rotation.coeffs(), Eigen::Vector4d(0.6, 0, 0, 0.8));
}

TEST_F(GivenPosesTest, nothing_beyond_the_ends_but_rounded_stamps) {
  const auto path = write("poses.txt", "1.0009 10 0 0 0 0 0 1\n1.1 11 0 0 0 0 0 1\n1.1989 12 0 0 0 0 0 1\n");
  expect_xs(sequence_of("TUM", {10, 11, 12}, 10), with(path), {10, 11, -1});
}

TEST_F(GivenPosesTest, rotations_are_interpolated_by_slerp) {
  const double half = std::numbers::pi / 3;  // of a turn by 120 degrees about z
  const auto path =
      write("poses.txt", "0 0 0 0 0 0 0 1\n0.1 1 2 4 0 0 " + std::to_string(-std::sin(half)) + " " +
                             std::to_string(-std::cos(half)) + "\n");  // -q is the same rotation
  const auto poses = poses_of_frames(sequence_of("TUM", {1}, 40), with(path));
  const Rigid3 expected{rotation_exp({0, 0, 2 * half / 4}), {0.25, 0.5, 1}};
  EXPECT_LT(left_perturbation(*poses[0], expected).norm(), 1e-6);
}

TEST_F(GivenPosesTest, the_offset_is_added_to_the_poses) {
  const auto path = write("poses.txt", "10 10 0 0 0 0 0 1\n10.1 11 0 0 0 0 0 1\n");
  expect_xs(sequence_of("TUM", {100, 101, 102}, 10), with(path, 0.15, 0.05), {-1, 10.5, -1});
  expect_xs(sequence_of("TUM", {100, 101, 102}, 10), with(path, 0.15, -0.1), {11, -1, -1});
}

TEST_F(GivenPosesTest, by_number_whatever_the_clock_says) {
  const auto path = write("poses.txt", "5 10 0 0 0 0 0 1\n7 11 0 0 0 0 0 1\n");
  for (const double rate_hz : {30.0, 1.0, 9.6}) {
    Sequence sequence = sequence_of("KITTI", {4, 5, 6, 7}, rate_hz);
    sequence.calibration.rate_hz = 30;  // KITTI's times do not follow it
    expect_xs(sequence, with(path), {-1, 10, -1, 11});
  }
}

TEST_F(GivenPosesTest, whole_seconds_are_times_in_a_tum_sequence) {
  const auto path = write("poses.txt", "1 10 0 0 0 0 0 1\n2 11 0 0 0 0 0 1\n");
  expect_xs(sequence_of("TUM", {0, 10, 20}, 10), with(path), {-1, 10, 11});
}

TEST_F(GivenPosesTest, the_truth_where_no_file_is_given) {
  Sequence sequence = sequence_of("7-Scenes", {0, 1, 2}, 1000);
  sequence.truth = Trajectory{{0, {}}, {1'000'000, {}}};
  sequence.truth->at(1).world_from_camera.translation.x() = 5;
  expect_xs(sequence, {}, {0, 5, -1});
  EXPECT_EQ(read_given_poses(sequence).format, "truth");
  sequence.frames.erase(sequence.frames.begin() + 1);  // its pose must not go to its neighbour, 1 ms away
  expect_xs(sequence, {}, {0, -1});
  sequence.format = "TUM";  // there it is a rounded stamp
  expect_xs(sequence, {}, {0, 5});
}

TEST_F(GivenPosesTest, kitti_has_a_line_for_each_frame_before_some_were_chosen) {
  const auto path =
      write("poses.txt", "1 0 0 10 0 1 0 0 0 0 1 0\n1 0 0 11 0 1 0 0 0 0 1 0\n0 0 1 12 1 0 0 0 0 1 0 0\n");
  Sequence sequence = sequence_of("KITTI", {5, 6, 9}, 10);
  expect_xs(sequence, with(path), {10, 11, 12});
  sequence.frames.erase(sequence.frames.begin(), sequence.frames.begin() + 2);
  const auto poses = poses_of_frames(sequence, with(path));
  ASSERT_EQ(poses.size(), 1U);
  EXPECT_LT(left_perturbation(*poses[0], {Eigen::Quaterniond(0.5, 0.5, 0.5, 0.5), {12, 0, 0}}).norm(), 1e-12);
}

TEST_F(GivenPosesTest, euroc_poses_are_of_the_body) {
  Sequence sequence = sequence_of("KITTI", {1, 2}, 10);
  const auto path = write("data.csv",
                          "#timestamp [ns], p_RS_R_x [m], ...\n100000000,1,2,3,1,0,0,0,9,9\n"
                          "200000000,1,2,3,0,0,0,1,9,9\n");
  sequence.calibration.body_from_camera = Rigid3{Eigen::Quaterniond(0.5, 0.5, 0.5, 0.5), {0.5, 0, 0}};
  for (const auto& given : {path, folder_}) {
    const GivenPoses poses = read_given_poses(sequence, with(given));
    EXPECT_EQ(poses.format, "EuRoC");
    EXPECT_FALSE(poses.frames[0]->uncertainty);
    EXPECT_EQ(poses.frames[0]->world_from_camera.translation, Eigen::Vector3d(1.5, 2, 3));
    EXPECT_LT((poses.frames[1]->world_from_camera.translation - Eigen::Vector3d(0.5, 2, 3)).norm(), 1e-12);
    const Eigen::Vector3d ahead = poses.frames[1]->world_from_camera.rotation * Eigen::Vector3d::UnitZ();
    EXPECT_LT((ahead - Eigen::Vector3d(-1, 0, 0)).norm(), 1e-12);  // the body's x, turned by half a turn
  }
}

TEST_F(GivenPosesTest, of_a_raw_pair_they_are_of_the_rectified_left_camera) {
  Sequence sequence = sequence_of("KITTI", {1}, 10);
  const auto path = write("data.csv", "100000000,1,2,3,1,0,0,0\n");
  const Rigid3 body_from_left{rotation_exp({0.1, 0.2, 0.3}), {1, 0, 0}};
  const Eigen::Quaterniond rectified_from_left = rotation_exp({0.02, -0.01, 0.03});
  sequence.calibration.body_from_camera = body_from_left;
  sequence.calibration.raw_stereo.emplace();
  sequence.calibration.raw_stereo->rectification.rectified_from_left = rectified_from_left;
  const Rigid3 expected{body_from_left.rotation * rectified_from_left.conjugate(), {2, 2, 3}};
  EXPECT_LT(left_perturbation(*poses_of_frames(sequence, with(path))[0], expected).norm(), 1e-12);
}

struct BrokenFile {
  const char* contents;
  std::string rest;  ///< of the message, behind the file's name
};

TEST_F(GivenPosesTest, broken_files_are_refused) {
  const std::string clock =
      "If only the clocks differ, add --pose-offset -77.5, or --pose-offset start, which align the first "
      "stamps; "
      "else check that the poses belong to this sequence and share its clock.";
  const std::string gap =
      "The times overlap: raise --pose-gap, or check that the poses belong to this sequence.";
  const std::string within =
      ": expected poses within the time of the frames, 0.000000000 to 0.200000000, at most 0.15 s apart, "
      "found ";
  const BrokenFile cases[] = {
      {"77.5 0 0 0 0 0 0 1\n", within + "1 from 77.500000000 to 77.500000000.\n  " + clock},
      {"0.05 0 0 0 0 0 0 1\n0.25 0 0 0 0 0 0 1\n", within + "2 from 0.050000000 to 0.250000000.\n  " + gap},
      {"77 0 0 0 0 0 0 1\n",
       ": expected poses of the sequence's frame numbers, found none.\n  Check that the poses belong to this "
       "sequence."},
      {"1 0 0 0\n",
       ":1: expected 8 values (t tx ty tz qx qy qz qw), found 4.\n  Correct or delete the line."},
      {"",
       ": expected poses, one a line: t tx ty tz qx qy qz qw, found none.\n  Check that this is the right "
       "file."},
      {"1 0 0 0 0 1 0 0 0 0 1 0\n",
       ": expected 3 poses, one for each frame of recording, found 1.\n  Add or delete lines, or give the "
       "poses "
       "with time stamps (TUM format)."},
      {"1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 0\n",
       ":2: expected 12 values (3x4 world_from_camera by rows), found 4.\n  Correct or delete the line."},
      {"1,2,3\n",
       ":1: expected 8 values (stamp, px, py, pz, qw, qx, qy, qz, ...), or a first line that names the "
       "columns, found 3.\n  Add a line with the names of the columns (docs/poses.md)."},
      {"1,0,0,0,1,0,0,0\n2,3\n",
       ":2: expected 8 values (stamp, px, py, pz, qw, qx, qy, qz, ...), found 2.\n  Correct or delete the "
       "line."},
      {"1,0,0,0,1,0,0,0\n1.5,0,0,0,1,0,0,0\n",
       ":2: expected a time stamp in whole nanoseconds, found '1.5'.\n  Correct or delete the "
       "line."},
  };
  Sequence sequence = sequence_of("7-Scenes", {0, 1, 2}, 10);
  sequence.calibration.body_from_camera.emplace();
  for (const BrokenFile& broken : cases) {
    const auto path = write("poses.txt", broken.contents);
    EXPECT_EQ(message_of([&] { return read_given_poses(sequence, with(path)); }),
              path.string() + broken.rest);
  }
}

TEST_F(GivenPosesTest, what_is_missing_is_said) {
  const Sequence sequence = sequence_of("7-Scenes", {0, 1, 2}, 10);
  EXPECT_EQ(
      message_of([&] { return read_given_poses(sequence); }),
      "recording: expected poses, found a sequence that carries none.\n  Give --poses FILE (docs/poses.md).");
  EXPECT_EQ(message_of([&] { return read_given_poses(sequence, with(folder_ / "none.txt")); }),
            (folder_ / "none.txt").string() +
                ": expected a readable file, found No such file or directory.\n  Check the path and its "
                "permissions.");
  EXPECT_EQ(message_of([&] { return read_given_poses(sequence, with(folder_)); }),
            folder_.string() +
                ": expected poses: OXTS packets (data/ and timestamps.txt), a data.csv as EuRoC's, or a "
                "run's trajectory.txt, found a folder without them.\n  Name the file or the folder that "
                "holds the poses.");
  const auto euroc = write("data.csv", "0,1,2,3,1,0,0,0\n");
  EXPECT_EQ(
      message_of([&] { return read_given_poses(sequence, with(euroc)); }),
      "camera.yaml: expected 'body: {body_from_camera: ...}', lever arm and boresight of the camera, as the "
      "poses (EuRoC) are of a body, found none.\n  Add it to camera.yaml. For a camera at the body's origin "
      "that looks forward: body: {body_from_camera: {translation: [0, 0, 0], quaternion_xyzw: [-0.5, 0.5, "
      "-0.5, 0.5]}} (body: x forward, y left, z up).");
}

TEST_F(GivenPosesTest, wrong_options_are_refused) {
  const Sequence sequence = sequence_of("7-Scenes", {0, 1, 2}, 10);
  const auto path = write("poses.txt", "0.1 0 0 0 0 0 0 1\n"),
             numbers = write("numbers.txt", "1 0 0 0 0 0 0 1\n");
  const auto message = [&](const GivenPosesOptions& options) {
    return message_of([&] { return read_given_poses(sequence, options); });
  };
  EXPECT_EQ(message(with(path, -1)),
            "max_gap_s: expected seconds from 0 to 9e9, found -1.\n  Correct the value.");
  EXPECT_EQ(message(with(path, NAN)),
            "max_gap_s: expected seconds from 0 to 9e9, found nan.\n  Correct the value.");
  EXPECT_EQ(message(with(path, 0.1, 1e10)),
            "time_offset_s: expected seconds from -9e9 to 9e9, found 10000000000.\n  Correct the value.");
  EXPECT_EQ(message(with(numbers, 0.1, 1)),
            "time_offset_s: expected 0, as these poses belong to frames by their numbers, found 1.\n  Leave "
            "it out.");
  const auto late = write("late.txt", "8999999999 0 0 0 0 0 0 1\n8999999999.5 0 0 0 0 0 0 1\n");
  EXPECT_EQ(message(with(late, 0.1, 9e9)),
            "time_offset_s: expected an offset that leaves the stamps within 292 years of 1970, found "
            "9000000000.\n  Correct the value.");
  GivenPosesOptions options = with(path);
  options.origin = GeodeticOrigin{91, 0, 0};
  EXPECT_EQ(message(options),
            "origin: expected a latitude from -90 to 90 degrees, found 91.\n  Correct the value.");
}

/// A pose for each image: interpolation changes nothing.
TEST(GivenPosesData, poses_at_the_images_stamps_stay_as_they_are) {
  const fs::path folder = fs::path(CAIRN_DATA_DIR) / "stereo/kitti_0039";
  if (!fs::exists(folder)) GTEST_SKIP() << "no " << folder;
  const Sequence sequence = open_sequence(folder);
  GivenPosesOptions file;
  file.path = folder / "poses.txt";
  const GivenPoses own = read_given_poses(sequence), given = read_given_poses(sequence, file);
  EXPECT_EQ(own.without_pose, 0U);
  EXPECT_EQ(given.format, "KITTI");
  for (std::size_t i = 0; i < sequence.frames.size(); ++i) {
    const Rigid3& truth = sequence.truth->at(i).world_from_camera;
    EXPECT_LT(left_perturbation(own.frames.at(i)->world_from_camera, truth).norm(), 1e-12);
    EXPECT_LT(left_perturbation(given.frames.at(i)->world_from_camera, truth).norm(), 1e-12);
  }
}

/// Between the two true poses about an image, no further from either than they are apart.
TEST(GivenPosesData, truth_at_a_hundred_hertz_stays_near_the_nearest) {
  const fs::path folder = fs::path(CAIRN_DATA_DIR) / "rgbd/fr1_desk_excerpt";
  if (!fs::exists(folder)) GTEST_SKIP() << "no " << folder;
  SequenceOptions options;
  options.camera = "tum-fr1";
  const Sequence sequence = open_sequence(folder, options);
  const GivenPoses given = read_given_poses(sequence);
  EXPECT_EQ(given.without_pose, 0U);
  for (std::size_t i = 0; i < sequence.frames.size(); ++i) {
    const auto later = std::lower_bound(
        sequence.truth->begin(), sequence.truth->end(), sequence.frames[i].stamp_ns,
        [](const StampedPose& pose, std::int64_t stamp_ns) { return pose.stamp_ns < stamp_ns; });
    const Rigid3& pose = given.frames.at(i)->world_from_camera;
    const double step = left_perturbation((later - 1)->world_from_camera, later->world_from_camera).norm();
    EXPECT_LT(left_perturbation(pose, later->world_from_camera).norm(), step + 1e-9);
    EXPECT_LT(left_perturbation(pose, (later - 1)->world_from_camera).norm(), step + 1e-9);
  }
}

}  // namespace
}  // namespace cairn
