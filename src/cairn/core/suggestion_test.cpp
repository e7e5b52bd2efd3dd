// SPDX-License-Identifier: Apache-2.0
#include "cairn/core/suggestion.h"

#include <gtest/gtest.h>

#include "cairn/core/error.h"

namespace cairn {
namespace {

TEST(Suggestion, names_only_what_is_near) {
  EXPECT_EQ(suggestion("rihgt", {"left", "right"}, "No."), "Did you mean 'right'?");
  EXPECT_EQ(suggestion("OBR", {"SIFT", "ORB"}, "No."), "Did you mean 'ORB'?");
  EXPECT_EQ(suggestion("fxx", {"fx", "fy"}, "No."), "Did you mean 'fx'?");
  EXPECT_EQ(suggestion("lever", {"left", "body_from_camera"}, "Known are two."), "Known are two.");
  EXPECT_EQ(suggestion("", {"a"}, "No."), "No.");
  EXPECT_THROW((void)suggestion("a", {}, "No."), PreconditionError);
}

}  // namespace
}  // namespace cairn
