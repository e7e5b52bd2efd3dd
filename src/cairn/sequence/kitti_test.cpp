// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "cairn/core/file.h"
#include "cairn/image/codec.h"
#include "cairn/sequence/sequence.h"
#include "cairn/simulate/write_kitti.h"
#include "cairn/testing/core/temporary_folder.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLeft = "P0: 700 0 300 0 0 710 100 0 0 0 1 0\n";
constexpr const char* kRight = "P1: 700 0 300 -350 0 710 100 0 0 0 1 0\n";
constexpr const char* kPoses =
    "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 0 0 1 0 0 0 0 1 2.5\n0 0 1 0 0 1 0 0 -1 0 0 5\n";

class KittiTest : public testing::Test {
 protected:
  KittiTest() { make_good(); }

  /// Three frames, numbers with a gap.
  void make_good() const {
    temporary_.clear();
    for (const char* camera : {"image_0", "image_1"}) {
      fs::create_directories(folder_ / camera);
      for (const char* name : {"000005.png", "000006.png", "000009.png"})
        write_png(folder_ / camera / name, GrayImage(8, 6, 90));
    }
    write("calib.txt", std::string(kLeft) + kRight);
    write("times.txt", "0.000000e+00\n1.036e-01\n4.1e-01\n");
    write("poses.txt", kPoses);
  }
  void write(const char* name, const std::string& text) const { temporary_.write(name, text); }

  const testkit::TemporaryFolder temporary_;
  const fs::path& folder_ = temporary_.path();
};

TEST_F(KittiTest, reads_frames_calibration_and_truth) {
  const Sequence sequence = open_sequence(folder_);
  EXPECT_EQ(sequence.format, "KITTI");
  ASSERT_EQ(sequence.frames.size(), 3U);
  EXPECT_EQ(sequence.frames[2].number, 9);
  EXPECT_EQ(sequence.frames[2].stamp_ns, 410'000'000);
  EXPECT_EQ(sequence.frames[2].color, folder_ / "image_0" / "000009.png");
  EXPECT_EQ(sequence.frames[2].right, folder_ / "image_1" / "000009.png");
  const Camera& camera = sequence.calibration.camera;
  EXPECT_EQ(camera.width, 8);
  EXPECT_EQ(camera.height, 6);
  EXPECT_EQ(camera.fx, 700);
  EXPECT_EQ(camera.fy, 710);
  EXPECT_EQ(camera.cx, 300);
  EXPECT_EQ(camera.cy, 100);
  EXPECT_EQ(sequence.calibration.baseline, 0.5);
  ASSERT_TRUE(sequence.truth);
  const StampedPose& last = sequence.truth->back();
  EXPECT_EQ(last.stamp_ns, 410'000'000);
  EXPECT_LT((last.world_from_camera * Eigen::Vector3d(0, 0, 1) - Eigen::Vector3d(1, 0, 5)).norm(), 1e-12);
}

TEST_F(KittiTest, colour_pairs_are_read_with_their_own_projections) {
  const Sequence grey = open_sequence(folder_);
  fs::rename(folder_ / "image_0", folder_ / "image_2");
  fs::rename(folder_ / "image_1", folder_ / "image_3");
  // 6 cm left of camera 0, 1 cm above and 3 mm behind: K t, with K of focal lengths 700 and 710
  write("calib.txt", std::string(kLeft) + kRight +
                         "P2: 700 0 300 42.9 0 710 100 7.4 0 0 1 0.003\n"
                         "P3: 700 0 300 -307.1 0 710 100 7.4 0 0 1 0.003\n");
  const Sequence color = open_sequence(folder_);
  ASSERT_EQ(color.frames.size(), 3U);
  EXPECT_EQ(color.frames[2].color, folder_ / "image_2" / "000009.png");
  EXPECT_EQ(color.frames[2].right, folder_ / "image_3" / "000009.png");
  EXPECT_NEAR(color.calibration.baseline.value(), 0.5, 1e-12);
  for (std::size_t i = 0; i < 3; ++i) {
    const Rigid3 moved = grey.truth->at(i).world_from_camera.inverse() * color.truth->at(i).world_from_camera;
    EXPECT_LT((moved.translation - Eigen::Vector3d(-0.06, -0.01, -0.003)).norm(), 1e-9);
  }
}

TEST_F(KittiTest, images_may_have_extensions_in_capitals) {
  for (const char* camera : {"image_0", "image_1"})
    for (const char* name : {"000005", "000006", "000009"})
      fs::rename(folder_ / camera / (std::string(name) + ".png"),
                 folder_ / camera / (std::string(name) + ".PNG"));
  const Sequence sequence = open_sequence(folder_);
  ASSERT_EQ(sequence.frames.size(), 3U);
  EXPECT_EQ(sequence.frames[2].color, folder_ / "image_0" / "000009.PNG");
}

TEST_F(KittiTest, names_without_leading_zeros_come_in_natural_order) {
  std::string times;
  for (const char* camera : {"image_0", "image_1"}) {
    fs::remove_all(folder_ / camera);
    fs::create_directories(folder_ / camera);
    for (int i = 0; i < 12; ++i)
      write_png(folder_ / camera / (std::to_string(i) + ".png"), GrayImage(8, 6, 90));
  }
  for (int i = 0; i < 12; ++i) times += std::to_string(i) + "\n";
  write("times.txt", times);
  fs::remove(folder_ / "poses.txt");
  const Sequence sequence = open_sequence(folder_);
  ASSERT_EQ(sequence.frames.size(), 12U);
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_EQ(sequence.frames[i].number, static_cast<std::int64_t>(i));
    EXPECT_EQ(sequence.frames[i].right.filename(), std::to_string(i) + ".png");
  }
}

/// times.txt still lists it.
TEST_F(KittiTest, an_image_missing_on_disk_keeps_its_place) {
  fs::remove(folder_ / "image_1/000006.png");
  fs::remove(folder_ / "image_0/000009.png");
  const Sequence sequence = open_sequence(folder_);
  ASSERT_EQ(sequence.frames.size(), 3U);
  EXPECT_EQ(sequence.frames[1].number, 6);
  EXPECT_EQ(sequence.frames[2].stamp_ns, 410'000'000);
  EXPECT_EQ(sequence.report.associated, 1);
  EXPECT_NO_THROW((void)FrameLoader(sequence).load({0}));
  EXPECT_THROW((void)FrameLoader(sequence).load({1}), InputError);
  EXPECT_THROW((void)FrameLoader(sequence).load({2}), InputError);
}

TEST_F(KittiTest, a_pair_missing_on_disk_keeps_its_place_where_names_are_positions) {
  for (const char* camera : {"image_0", "image_1"}) {
    fs::rename(folder_ / camera / "000005.png", folder_ / camera / "000001.png");
    fs::rename(folder_ / camera / "000006.png", folder_ / camera / "000002.png");
    fs::rename(folder_ / camera / "000009.png", folder_ / camera / "000004.png");
  }
  fs::remove(folder_ / "poses.txt");
  write("times.txt", "0\n1\n2\n3\n4\n");
  const Sequence sequence = open_sequence(folder_);
  ASSERT_EQ(sequence.frames.size(), 5U);
  EXPECT_EQ(sequence.frames[0].color, folder_ / "image_0/000000.png");
  EXPECT_EQ(sequence.frames[3].right, folder_ / "image_1/000003.png");
  EXPECT_EQ(sequence.frames[4].stamp_ns, 4'000'000'000);
  EXPECT_EQ(sequence.calibration.camera.width, 8);
}

TEST_F(KittiTest, the_size_is_that_of_the_images_that_can_be_read) {
  write("image_0/000005.png", "");
  EXPECT_EQ(open_sequence(folder_).calibration.camera.width, 8);
  write_png(folder_ / "image_0/000005.png", GrayImage(4, 3, 90));
  EXPECT_EQ(open_sequence(folder_).calibration.camera.height, 6) << "the first one is the odd one out";
}

TEST_F(KittiTest, truth_may_be_missing) {
  fs::remove(folder_ / "poses.txt");
  EXPECT_FALSE(open_sequence(folder_).truth);
}

TEST_F(KittiTest, rotations_with_rounded_digits_become_rotations) {
  write("poses.txt", "0.9999 0 0 0 0 1.0001 0 0 0 0 1 0\n1 0 0 0 0 1 0 0 0 0 1 1\n1 0 0 0 0 1 0 0 0 0 1 2\n");
  EXPECT_NEAR(open_sequence(folder_).truth->front().world_from_camera.rotation.norm(), 1, 1e-12);
}

struct BrokenCase {
  const char* what;
  std::function<void(const fs::path&)> spoil;
  const char* file;  ///< that the message names, from the sequence's folder
  int line;
  const char* expected;
  const char* found;
};

std::function<void(const fs::path&)> text(const char* name, const std::string& contents) {
  return [=](const fs::path& folder) { write_file(folder / name, contents); };
}

std::function<void(const fs::path&)> removal(const char* name) {
  return [=](const fs::path& folder) { fs::remove_all(folder / name); };
}

const BrokenCase kBrokenFolders[] = {
    {"no right folder", removal("image_1"), "image_1", 0, "a folder with the images of one camera", "none"},
    {"a right image without time",
     [](const fs::path& folder) { write_png(folder / "image_1/000007.png", GrayImage(8, 6, 90)); },
     "image_0/000007.png", 0, "the partner of ", "no such file"},
    {"a left image without time",
     [](const fs::path& folder) { write_png(folder / "image_0/000010.png", GrayImage(8, 6, 90)); },
     "image_1/000010.png", 0, "the partner of ", "no such file"},
    {"no right images",
     [](const fs::path& folder) {
       fs::remove_all(folder / "image_1");
       fs::create_directories(folder / "image_1");
     },
     "image_1/000005.png", 0, "the partner of ", "no such file"},
    {"no times", removal("times.txt"), "times.txt", 0, "a readable file", "No such file or directory"},
    {"no calibration", removal("calib.txt"), "calib.txt", 0, "a readable file", "No such file or directory"},
    {"no image at all",
     [](const fs::path& folder) {
       for (const char* name : {"000005.png", "000006.png", "000009.png"})
         write_file(folder / "image_0" / name, "no image");
     },
     "image_0/000005.png", 0, "a PNG, JPEG, PGM or PPM image",
     "another kind of file; and none of 3 frames can be read"},
};

const BrokenCase kBrokenTexts[] = {
    {"too few times", text("times.txt", "0\n1\n"), "times.txt", 0, "3 times, one for each image in image_0",
     "2"},
    {"too many times", text("times.txt", "0\n1\n2\n3\n"), "times.txt", 0,
     "3 times, one for each image in image_0", "4"},
    {"word for a time", text("times.txt", "0\nx\n2\n"), "times.txt", 2, "a time in seconds", "'x'"},
    {"time runs back", text("times.txt", "0\n2\n1\n"), "times.txt", 3, "a time after 2.000000000",
     "1.000000000"},
    {"two columns", text("times.txt", "0 1\n1 2\n2 3\n"), "times.txt", 1, "1 values (seconds)", "2"},
    {"no P1", text("calib.txt", kLeft), "calib.txt", 0, "a line 'P1: ...'", "none"},
    {"short P0", text("calib.txt", "P0: 1 2 3\n"), "calib.txt", 1, "13 values (P0: and a 3x4 matrix by rows)",
     "4"},
    {"word in P0", text("calib.txt", "P0: f 0 300 0 0 710 100 0 0 0 1 0\n"), "calib.txt", 1,
     "a number for P0:", "'f'"},
    {"no focal length",
     text("calib.txt", "P0: 0 0 300 0 0 710 100 0 0 0 1 0\nP1: 0 0 300 -350 0 710 100 0 0 0 1 0\n"),
     "calib.txt", 0, "a focal length above 0 in P0", "0"},
    {"no baseline", text("calib.txt", std::string(kLeft) + "P1: 700 0 300 0 0 710 100 0 0 0 1 0\n"),
     "calib.txt", 0, "the right camera to the right of the left one, a baseline above 0 m", "0"},
    {"unrectified", text("calib.txt", std::string(kLeft) + "P1: 701 0 300 -350 0 710 100 0 0 0 1 0\n"),
     "calib.txt", 0, "P1 with the focal lengths and centre of P0 (rectified images): 700", "701"},
    {"too few poses", text("poses.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n"), "poses.txt", 0,
     "3 poses, one for each image", "1"},
    {"short pose", text("poses.txt", "1 0 0 0\n1 0 0 0\n1 0 0 0\n"), "poses.txt", 1,
     "12 values (3x4 world_from_camera by rows)", "4"},
    {"word in a pose",
     text("poses.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 nan 0 1 0 0 0 0 1 0\n1 0 0 0 0 1 0 0 0 0 1 0\n"),
     "poses.txt", 2, "a number for the pose", "'nan'"},
    {"no rotation",
     text("poses.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 0 0 2 0 0 0 0 1 0\n1 0 0 0 0 1 0 0 0 0 1 0\n"),
     "poses.txt", 2, "a rotation in columns 1-3, 5-7, 9-11",
     "a matrix that is none (R^T R differs from 1 by 3)"},
    {"mirrored",
     text("poses.txt", "-1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 0 0 1 0 0 0 0 1 0\n"),
     "poses.txt", 1, "a rotation in columns 1-3, 5-7, 9-11", "a matrix that mirrors"},
};

void expect_refused(const BrokenCase& broken, const fs::path& folder) {
  SCOPED_TRACE(broken.what);
  broken.spoil(folder);
  try {
    const Sequence sequence = open_sequence(folder);
    ADD_FAILURE() << "was read";
  } catch (const InputError& error) {
    EXPECT_EQ(error.details().file, (folder / broken.file).string());
    EXPECT_EQ(error.details().line, broken.line);
    EXPECT_TRUE(error.details().expected.starts_with(broken.expected)) << error.details().expected;
    EXPECT_EQ(error.details().found, broken.found);
    EXPECT_FALSE(error.details().remedy.empty());
  }
}

TEST_F(KittiTest, refuses_broken_folders) {
  for (const BrokenCase& broken : kBrokenFolders) {
    make_good();
    expect_refused(broken, folder_);
  }
}

TEST_F(KittiTest, refuses_broken_texts) {
  for (const BrokenCase& broken : kBrokenTexts) {
    make_good();
    expect_refused(broken, folder_);
  }
}

TEST_F(KittiTest, simulated_street_is_read_back) {
  temporary_.clear();
  SimulateStreetOptions options;
  options.camera.width = 124;
  options.camera.height = 38;
  options.camera.fx = options.camera.fy = 72.15;
  options.camera.cx = 60.5;
  options.camera.cy = 17.5;
  options.frames_count = 4;
  const SimulatedStreet street(options);
  Progress silent;
  EXPECT_EQ(write_kitti(street, folder_, true, Executor(2), silent).frames, 4);

  const Sequence sequence = open_sequence(folder_);
  ASSERT_EQ(sequence.frames.size(), 4U);
  EXPECT_NEAR(*sequence.calibration.baseline, 0.537, 1e-12);
  EXPECT_DOUBLE_EQ(sequence.calibration.camera.cx, 60.5);
  const SimulatedStereoFrame expected = street.render(3);
  EXPECT_TRUE(read_gray(sequence.frames[3].color) == expected.left);
  EXPECT_TRUE(read_gray(sequence.frames[3].right) == expected.right);
  EXPECT_NEAR(read_depth(folder_ / "depth_truth/000003.png")(60, 30) / 256.0, expected.depth_true(60, 30),
              0.002);
  const Rigid3 difference = (*sequence.truth)[3].world_from_camera.inverse() * street.world_from_camera(3);
  EXPECT_LT(motion_norm(difference), 1e-9);
}

TEST(kitti, real_recording_opens) {
  const fs::path folder = fs::path(CAIRN_DATA_DIR) / "stereo/kitti_0039";
  if (!fs::exists(folder)) GTEST_SKIP() << "no " << folder;
  const Sequence sequence = open_sequence(folder);
  EXPECT_EQ(sequence.frames.size(), 200U);
  EXPECT_EQ(sequence.frames[0].number, 5);
  EXPECT_NEAR(*sequence.calibration.baseline, 0.53715, 1e-5);
  EXPECT_EQ(sequence.truth->size(), 200U);
}

/// Of a rectified sequence all that is read is written again; stamps to the nanosecond.
TEST_F(KittiTest, a_rectified_sequence_is_written_as_it_is) {
  write("times.txt", "1403715273.262142976\n1403715273.312142976\n1403715273.362142976\n");
  const fs::path written = folder_ / "written";
  fs::create_directories(written);
  const Sequence sequence = open_sequence(folder_);
  Progress silent;
  const RectifiedReport report = write_rectified(sequence, written, Executor(2), silent);
  EXPECT_EQ(report.frames, 3);
  EXPECT_TRUE(report.has_poses);
  EXPECT_FALSE(report.stopped);
  const Sequence again = open_sequence(written);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(again.frames[i].stamp_ns, sequence.frames[i].stamp_ns);
    EXPECT_EQ(read_gray(again.frames[i].right), read_gray(sequence.frames[i].right));
    EXPECT_LT(left_perturbation(again.truth->at(i).world_from_camera, sequence.truth->at(i).world_from_camera)
                  .norm(),
              1e-9);
  }
  EXPECT_EQ(again.calibration.camera.fx, sequence.calibration.camera.fx);
  EXPECT_EQ(again.calibration.baseline, sequence.calibration.baseline);
}

TEST_F(KittiTest, without_all_poses_none_are_written) {
  Sequence sequence = open_sequence(folder_);
  sequence.truth->pop_back();
  const fs::path written = folder_ / "written";
  fs::create_directories(written);
  Progress silent;
  EXPECT_FALSE(write_rectified(sequence, written, Executor(), silent).has_poses);
  EXPECT_FALSE(fs::exists(written / "poses.txt"));
}

}  // namespace
}  // namespace cairn
