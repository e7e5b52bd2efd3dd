// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/trajectory_words.h"

#include <gtest/gtest.h>

namespace cairn {
namespace {

TEST(TrajectoryWords, shorten_paths_to_their_last_two_parts) {
  EXPECT_EQ(short_name("/data/run/trajectory.txt"), "run/trajectory.txt");
  EXPECT_EQ(short_name("data/run/"), "data/run");
  EXPECT_EQ(short_name("a/../run.txt"), "run.txt");
}

TEST(TrajectoryWords, name_intervals_with_their_units) {
  EXPECT_EQ(name_of(RpeOptions{1, RpeUnit::frames, false}), "1 frame");
  EXPECT_EQ(name_of(RpeOptions{10, RpeUnit::frames, false}), "10 frames");
  EXPECT_EQ(name_of(RpeOptions{2.5, RpeUnit::metres, false}), "2.5 m");
  EXPECT_EQ(name_of(RpeOptions{0.5, RpeUnit::seconds, false}), "0.5 s");
}

TEST(TrajectoryWords, show_small_errors_in_centimetres) {
  EXPECT_EQ(unit_for(9.99).name, "cm");
  EXPECT_EQ(unit_for(9.99).factor, 100);
  EXPECT_EQ(unit_for(10).name, "m");
}

TEST(TrajectoryWords, have_a_word_and_a_reason_for_each_status) {
  EXPECT_EQ(word_for(AlignmentStatus::ok), "ok");
  EXPECT_EQ(explain(AlignmentStatus::ok), "");
  EXPECT_EQ(word_for(AlignmentStatus::mirrored), "mirrored");
  EXPECT_EQ(explain(AlignmentStatus::too_few_points), "fewer than 3 pairs of poses do not determine it");
  EXPECT_EQ(word_for(EvaluationStatus::no_pairs), "no_pairs");
  EXPECT_EQ(name_of(AlignmentMode::sim3), "sim3");
}

}  // namespace
}  // namespace cairn
