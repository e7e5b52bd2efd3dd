// SPDX-License-Identifier: Apache-2.0
#include "cairn/core/error.h"

#include <gtest/gtest.h>

#include <string>

namespace cairn {
namespace {

TEST(InputError, names_place_expected_found_and_remedy) {
  const InputError error({"poses.txt", 7, "8 values", "7", "Correct the line."});
  EXPECT_STREQ(error.what(), "poses.txt:7: expected 8 values, found 7.\n  Correct the line.");
  EXPECT_EQ(error.details().line, 7);
}

TEST(InputError, leaves_out_a_line_and_a_remedy_that_are_not_there) {
  EXPECT_STREQ(InputError({"--frames", 0, "A:B", "'x'", ""}).what(), "--frames: expected A:B, found 'x'.");
}

TEST(Require, is_silent_where_the_condition_holds) {
  EXPECT_NO_THROW(require(true, "anything"));
}

TEST(Require, names_the_requirement_and_the_callers_place) {
  try {
    require(false, "a count above 0");
    FAIL() << "no exception";
  } catch (const PreconditionError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("error_test.cpp"), std::string::npos) << text;
    EXPECT_NE(text.find("a count above 0"), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace cairn
