// SPDX-License-Identifier: Apache-2.0
#include "cairn/simulate/write_tum.h"

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "cairn/core/file.h"
#include "cairn/sequence/sequence.h"
#include "cairn/testing/core/temporary_folder.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;

SimulateRoomOptions tiny_room() {
  SimulateRoomOptions options;
  options.camera = resized(options.camera, 0.125);
  options.frames_count = 12;
  return options;
}

class WriteTumTest : public testing::Test {
 protected:
  /// Returns every file's name and bytes.
  std::map<std::string, std::string> contents() const { return testkit::contents_of(folder_); }

  const testkit::TemporaryFolder temporary_;
  const fs::path& folder_ = temporary_.path();
  Progress silent_;
};

/// Without noise a sensor that sees as far measures the truth.
TEST_F(WriteTumTest, writes_the_true_depth_if_it_is_asked_for) {
  SimulateRoomOptions options = tiny_room();
  options.noise = RgbdNoise::none;
  (void)write_tum(SimulatedRoom(options), folder_, Executor(2), silent_);
  EXPECT_FALSE(fs::exists(folder_ / "depth_truth"));
  (void)write_tum(SimulatedRoom(options), folder_, Executor(2), silent_, true);
  int count = 0;
  for (const auto& entry : fs::directory_iterator(folder_ / "depth_truth")) {
    EXPECT_EQ(read_file(entry.path()), read_file(folder_ / "depth" / entry.path().filename()));
    ++count;
  }
  EXPECT_EQ(count, options.frames_count);
}

TEST_F(WriteTumTest, is_read_back_by_the_tum_reader) {
  const SimulatedRoom room(tiny_room());
  const SimulationReport report = write_tum(room, folder_, Executor(), silent_);
  EXPECT_EQ(report.frames, 12);
  EXPECT_FALSE(report.stopped);
  EXPECT_NEAR(report.duration, 11 / 30.0, 1e-8);
  EXPECT_GT(report.length, 0.05);

  const Sequence sequence = open_sequence(folder_);
  EXPECT_EQ(sequence.format, "TUM");
  ASSERT_EQ(sequence.frames.size(), 12U);
  ASSERT_TRUE(sequence.truth);
  EXPECT_EQ(sequence.calibration.camera.fx, room.camera().fx);
  const SimulatedRgbdFrame expected = room.render(7);
  const FrameLoader loader(sequence);
  EXPECT_TRUE(loader.load_color({7}) == expected.color);
  EXPECT_NEAR(loader.load_depth({7})(40, 30), expected.depth(40, 30) / 5000.0, 1e-6);
  const Rigid3 difference = (*sequence.truth)[7].world_from_camera.inverse() * room.world_from_camera(7);
  EXPECT_LT(motion_norm(difference), 1e-8);
}

TEST_F(WriteTumTest, writes_the_same_bytes_at_any_number_of_threads) {
  const SimulatedRoom room(tiny_room());
  std::map<std::string, std::string> reference;
  for (const int threads : {1, 2, 4}) {
    write_tum(room, folder_, Executor(threads), silent_);
    if (threads == 1) reference = contents();
    EXPECT_TRUE(contents() == reference) << threads;
    EXPECT_EQ(reference.size(), 12U * 2 + 5);
  }
}

/// Asks to stop after some frames.
class StoppingProgress : public Progress {
 public:
  explicit StoppingProgress(std::int64_t frames) : frames_(frames) {}
  void update(std::int64_t done) override { done_ = done; }
  [[nodiscard]] bool stop_requested() const override { return done_ >= frames_; }

 private:
  std::int64_t frames_, done_ = 0;
};

TEST_F(WriteTumTest, stopped_leaves_a_whole_sequence_of_what_is_done) {
  StoppingProgress progress(5);
  const SimulationReport report = write_tum(SimulatedRoom(tiny_room()), folder_, Executor(2), progress);
  EXPECT_TRUE(report.stopped);
  EXPECT_EQ(report.frames, 5);
  EXPECT_EQ(open_sequence(folder_).frames.size(), 5U);
  EXPECT_EQ(contents().size(), 5U * 2 + 5);
}

TEST_F(WriteTumTest, unwritable_folder_is_an_input_error) {
  write_file(folder_ / "rgb", "a file where the folder belongs");
  EXPECT_THROW(write_tum(SimulatedRoom(tiny_room()), folder_, Executor(), silent_), InputError);
}

}  // namespace
}  // namespace cairn
