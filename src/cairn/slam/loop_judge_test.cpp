// SPDX-License-Identifier: Apache-2.0
#include "cairn/slam/loop_judge.h"

#include <gtest/gtest.h>

#include "cairn/testing/geometry/camera_paths.h"
#include "cairn/testing/map/point_world.h"

namespace cairn {
namespace {

/// Twenty keyframes half a metre apart in a row, and in component 1 three more.
class LoopJudgeTest : public testing::Test {
 protected:
  LoopJudgeTest() {
    for (std::int32_t k = 0; k < 20; ++k)
      (void)map_.add_keyframe(testkit::blank_frame(0), testkit::aside(0.5 * k), {k - 1}, 0);
    for (std::int32_t k = 20; k < 23; ++k)
      (void)map_.add_keyframe(testkit::blank_frame(0), testkit::aside(100 + 0.5 * k),
                              k == 20 ? KeyframeId{} : KeyframeId{k - 1}, 1);
  }

  /// That the world near `current` is to move by `correction`.
  [[nodiscard]] LoopHypothesis loop(std::int32_t candidate, std::int32_t current,
                                    const Rigid3& correction) const {
    return {{candidate},
            {current},
            map_.world_from_camera({candidate}).inverse() * correction * map_.world_from_camera({current}),
            50,
            false};
  }

  Map map_{testkit::kWorldRig, "ORB"};
  LoopJudge judge_;
};

TEST_F(LoopJudgeTest, one_that_agrees_bends_nothing) {
  LoopHypothesis loop = this->loop(0, 15, testkit::aside(0.01));
  loop.agrees = true;
  EXPECT_EQ(judge_.judge(map_, loop), LoopVerdict::agrees);
  EXPECT_EQ(judge_.judge(map_, loop), LoopVerdict::agrees);
}

TEST_F(LoopJudgeTest, one_is_believed_when_a_second_says_the_same) {
  EXPECT_EQ(judge_.judge(map_, loop(0, 15, testkit::aside(0.4))), LoopVerdict::unconfirmed);
  EXPECT_EQ(judge_.judge(map_, loop(1, 16, testkit::aside(0.42))), LoopVerdict::believed);
}

TEST_F(LoopJudgeTest, each_belief_needs_two_of_its_own) {
  (void)judge_.judge(map_, loop(0, 15, testkit::aside(0.4)));
  (void)judge_.judge(map_, loop(1, 16, testkit::aside(0.4)));
  EXPECT_EQ(judge_.judge(map_, loop(2, 17, testkit::aside(0.4))), LoopVerdict::unconfirmed);
}

TEST_F(LoopJudgeTest, a_second_that_contradicts_is_a_new_first) {
  EXPECT_EQ(judge_.judge(map_, loop(0, 15, testkit::aside(0.4))), LoopVerdict::unconfirmed);
  EXPECT_EQ(judge_.judge(map_, loop(1, 16, testkit::aside(-0.4))), LoopVerdict::unconfirmed);
  EXPECT_EQ(judge_.judge(map_, loop(1, 17, testkit::aside(-0.4))), LoopVerdict::believed);
}

TEST_F(LoopJudgeTest, a_second_that_turns_otherwise_contradicts) {
  const Rigid3 centre = map_.world_from_camera({16});
  const Rigid3 turned =
      centre * Rigid3{rotation_exp({0, 0.1, 0}), {0, 0, 0}} * centre.inverse() * testkit::aside(0.4);
  (void)judge_.judge(map_, loop(0, 15, testkit::aside(0.4)));
  EXPECT_EQ(judge_.judge(map_, loop(1, 16, turned)), LoopVerdict::unconfirmed);
}

TEST_F(LoopJudgeTest, a_confirmation_may_not_be_long_in_coming) {
  (void)judge_.judge(map_, loop(0, 8, testkit::aside(0.3)));
  EXPECT_EQ(judge_.judge(map_, loop(0, 19, testkit::aside(0.3))), LoopVerdict::unconfirmed);
}

/// Half a metre and a tenth of the way: 1.25 m after 7.5 m.
TEST_F(LoopJudgeTest, odometry_drifts_by_no_more_than_a_share_of_the_way) {
  EXPECT_EQ(judge_.judge(map_, loop(0, 15, testkit::aside(1.2))), LoopVerdict::unconfirmed);
  EXPECT_EQ(judge_.judge(map_, loop(0, 15, testkit::aside(1.3))), LoopVerdict::implausible);
  EXPECT_EQ(judge_.judge(map_, loop(10, 15, testkit::aside(1.2))), LoopVerdict::implausible);
}

TEST_F(LoopJudgeTest, odometry_does_not_turn_round) {
  const auto turn = [&](double angle) {
    const Rigid3 at_current = map_.world_from_camera({15});
    return at_current * Rigid3{rotation_exp({0, angle, 0}), {0, 0, 0}} * at_current.inverse();
  };
  EXPECT_EQ(judge_.judge(map_, loop(0, 15, turn(0.3))), LoopVerdict::unconfirmed);
  EXPECT_EQ(judge_.judge(map_, loop(0, 15, turn(0.5))), LoopVerdict::implausible);
}

TEST_F(LoopJudgeTest, an_implausible_one_confirms_nothing) {
  (void)judge_.judge(map_, loop(0, 15, testkit::aside(3)));
  EXPECT_EQ(judge_.judge(map_, loop(1, 16, testkit::aside(3))), LoopVerdict::implausible);
}

/// Parts have no common world: any correction may be right, when two say the same.
TEST_F(LoopJudgeTest, components_are_joined_by_two_that_say_the_same) {
  EXPECT_EQ(judge_.judge(map_, loop(3, 21, testkit::aside(-95))), LoopVerdict::unconfirmed);
  EXPECT_EQ(judge_.judge(map_, loop(4, 22, testkit::aside(-95.05))), LoopVerdict::believed);
}

TEST_F(LoopJudgeTest, components_are_not_joined_by_two_that_differ) {
  EXPECT_EQ(judge_.judge(map_, loop(3, 21, testkit::aside(-95))), LoopVerdict::unconfirmed);
  EXPECT_EQ(judge_.judge(map_, loop(4, 22, testkit::aside(-94))), LoopVerdict::unconfirmed);
}

TEST_F(LoopJudgeTest, the_way_is_that_within_a_component) {
  EXPECT_NEAR(path_length(map_, {2}, {6}), 2, 1e-12);
  EXPECT_NEAR(path_length(map_, {18}, {22}), 1.5, 1e-12) << "nothing between the parts";
  map_.erase(KeyframeId{4});
  EXPECT_NEAR(path_length(map_, {2}, {6}), 2, 1e-12);
}

}  // namespace
}  // namespace cairn
