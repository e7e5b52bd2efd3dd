// SPDX-License-Identifier: Apache-2.0
#include "cairn/simd/instruction_set.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "cairn/simd/available.h"

namespace cairn {
namespace {

TEST(InstructionSet, plain_is_always_there_and_the_order_ascends) {
  const auto& sets = available_instruction_sets();
  ASSERT_FALSE(sets.empty());
  EXPECT_EQ(sets.front(), InstructionSet::plain);
  EXPECT_TRUE(std::is_sorted(sets.begin(), sets.end()));
}

TEST(InstructionSet, the_default_is_available) {
  const auto& sets = available_instruction_sets();
  EXPECT_NE(std::find(sets.begin(), sets.end(), default_instruction_set()), sets.end());
}

}  // namespace
}  // namespace cairn
