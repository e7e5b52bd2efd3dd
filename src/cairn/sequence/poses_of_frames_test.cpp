// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "cairn/sequence/test_sequence.h"

namespace cairn {
namespace {

class PosesOfFramesTest : public testing::Test, protected TestFolder {
 protected:
  /// Frames `numbers` at `rate_hz`; TUM sequences number them by position.
  static Sequence sequence_of(const char* format, const std::vector<std::int64_t>& numbers, double rate_hz) {
    Sequence sequence;
    sequence.folder = "recording";
    sequence.format = format;
    sequence.calibration.rate_hz = rate_hz;
    for (const std::int64_t number : numbers)
      sequence.frames.push_back(
          {std::llround(1e9 * static_cast<double>(number) / rate_hz), number, {}, {}, {}});
    return sequence;
  }
  /// The x of each pose, -1 where there is none.
  static std::vector<double> xs(const std::vector<std::optional<WorldFromCamera>>& poses) {
    std::vector<double> result;
    for (const auto& pose : poses) result.push_back(pose ? pose->translation.x() : -1);
    return result;
  }
  using Values = std::vector<double>;
};

TEST_F(PosesOfFramesTest, by_time) {
  const auto path = write("poses.txt", "0.01 10 0 0 0 0 0 1\n0.11 11 0 0 0 0 0 1\n0.25 12 0 0 0 0 0 1\n");
  for (const char* format : {"TUM", "7-Scenes", "KITTI"}) {
    const Sequence sequence = sequence_of(format, {0, 1, 2}, 10);
    EXPECT_EQ(xs(poses_of_frames(sequence, path)), (Values{10, 11, -1})) << format;
    EXPECT_EQ(xs(poses_of_frames(sequence, path, 0.06)), (Values{10, 11, 12})) << format;
  }
}

TEST_F(PosesOfFramesTest, by_number_whatever_the_clock_says) {
  const auto path = write("poses.txt", "5 10 0 0 0 0 0 1\n7 11 0 0 0 0 0 1\n");
  for (const double rate_hz : {30.0, 1.0, 9.6}) {
    Sequence sequence = sequence_of("KITTI", {4, 5, 6, 7}, rate_hz);
    sequence.calibration.rate_hz = 30;  // KITTI's times do not follow it
    EXPECT_EQ(xs(poses_of_frames(sequence, path)), (Values{-1, 10, -1, 11})) << rate_hz;
  }
}

TEST_F(PosesOfFramesTest, whole_seconds_are_times_in_a_tum_sequence) {
  const auto path = write("poses.txt", "1 10 0 0 0 0 0 1\n2 11 0 0 0 0 0 1\n");
  EXPECT_EQ(xs(poses_of_frames(sequence_of("TUM", {0, 10, 20}, 10), path)), (Values{-1, 10, 11}));
}

TEST_F(PosesOfFramesTest, the_truth_where_no_file_is_given) {
  Sequence sequence = sequence_of("7-Scenes", {0, 1, 2}, 1000);
  sequence.truth = Trajectory{{0, {}}, {1'000'000, {}}};
  sequence.truth->at(1).world_from_camera.translation.x() = 5;
  EXPECT_EQ(xs(poses_of_frames(sequence, "")), (Values{0, 5, -1}));
  sequence.frames.erase(sequence.frames.begin() + 1);  // its pose must not go to its neighbour, 1 ms away
  EXPECT_EQ(xs(poses_of_frames(sequence, "")), (Values{0, -1}));
}

TEST_F(PosesOfFramesTest, none_are_refused) {
  Sequence sequence = sequence_of("7-Scenes", {0, 1, 2}, 10);
  EXPECT_EQ(
      message_of([&] { return poses_of_frames(sequence, ""); }),
      "recording: expected poses, found a sequence that carries none.\n  Give --poses FILE (TUM format).");
  const char* const remedy =
      ", found none.\n  Check that the poses belong to this sequence and share its clock.";
  const auto times = write("times.txt", "77.5 0 0 0 0 0 0 1\n"),
             numbers = write("numbers.txt", "77 0 0 0 0 0 0 1\n");
  EXPECT_EQ(message_of([&] { return poses_of_frames(sequence, times); }),
            times.string() + ": expected poses within 0.02 s of the frames" + remedy);
  EXPECT_EQ(message_of([&] { return poses_of_frames(sequence, numbers); }),
            numbers.string() + ": expected poses of the sequence's frame numbers" + remedy);
}

}  // namespace
}  // namespace cairn
