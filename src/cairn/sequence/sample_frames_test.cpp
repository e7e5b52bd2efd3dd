// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/sample_frames.h"

#include <gtest/gtest.h>

namespace cairn {
namespace {

TEST(SampleFrames, lie_evenly_from_the_first_to_the_last) {
  EXPECT_EQ(sample_frames(101, 5), (std::vector<FrameId>{{0}, {25}, {50}, {75}, {100}}));
  EXPECT_EQ(sample_frames(3, 5), (std::vector<FrameId>{{0}, {1}, {2}}));
  EXPECT_EQ(sample_frames(9, 1), (std::vector<FrameId>{{0}}));
  EXPECT_TRUE(sample_frames(0, 5).empty());
}

}  // namespace
}  // namespace cairn
