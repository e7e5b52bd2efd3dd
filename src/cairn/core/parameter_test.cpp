// SPDX-License-Identifier: Apache-2.0
#include "cairn/core/parameter.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include "cairn/core/error.h"

namespace cairn {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

struct RangeCase {
  Range range;
  const char* words;
  double lowest, below, highest, beyond;  // the last and the first that are accepted and refused, either end
};

TEST(Range, says_itself_and_holds_to_it) {
  const double tiny = std::numeric_limits<double>::denorm_min(), most = std::numeric_limits<double>::max();
  const RangeCase cases[] = {
      {any("pixels"), "pixels", -most, -kInfinity, most, kInfinity},
      {above(0, "pixels"), "pixels above 0", tiny, 0, most, kInfinity},
      {above_up_to(0, 1, "a share"), "a share above 0, up to 1", tiny, 0, 1, 1.001},
      {from(0, "radians"), "radians from 0", 0, -tiny, most, kInfinity},
      {from(0, "frames", "none"), "frames from 0 (none)", 0, -1, most, kInfinity},
      {from_to(-1, 1, "a correlation"), "a correlation from -1 to 1", -1, -1.001, 1, 1.001},
      {from_to(0, 1, "a ratio", "off"), "a ratio from 0 (off) to 1", 0, -tiny, 1, 1.001},
      {from_to(0, 1e6, "seconds"), "seconds from 0 to 1000000", 0, -tiny, 1e6, 1.1e6},
      {at_least(2, "frames"), "at least 2 frames", 2, 1, most, kInfinity},
  };
  for (const RangeCase& c : cases) {
    EXPECT_EQ(c.range.describe(), c.words);
    EXPECT_TRUE(c.range.contains(c.lowest) && c.range.contains(c.highest)) << c.words;
    EXPECT_FALSE(c.range.contains(c.below) || c.range.contains(c.beyond)) << c.words;
    EXPECT_FALSE(c.range.contains(kNan)) << c.words;
  }
}

/// One field of each kind, all in range.
struct Options {
  double radius = 3;
  int count = 2;
  bool check = true;
  std::string name = "any";
  std::optional<double> depth = {};
  std::optional<std::int64_t> start = {};
};

void visit(Options& options, ParameterVisitor& visitor) {
  visitor.parameter({"radius", above(0, "pixels"), "A radius."}, options.radius);
  visitor.parameter({"count", at_least(1, "frame"), "A count.", "", "Correct the value."}, options.count);
  visitor.parameter({"check", {}, "A switch."}, options.check);
  visitor.parameter({"name", any("a name"), "A name."}, options.name);
  visitor.parameter({"depth", from(0, "metres"), "A depth."}, options.depth);
  visitor.parameter({"start", from(0, "a file number"), "A number."}, options.start);
}

std::string refusal(const Options& options) {
  try {
    check_ranges(options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(CheckRanges, names_the_parameter_its_range_and_the_remedy) {
  EXPECT_EQ(refusal({}), "");
  EXPECT_EQ(refusal({.radius = 0}),
            "radius: expected pixels above 0, found 0.\n  Leave it out for the default.");
  EXPECT_EQ(refusal({.count = 0}), "count: expected at least 1 frame, found 0.\n  Correct the value.");
  EXPECT_EQ(refusal({.depth = -0.5}),
            "depth: expected metres from 0, found -0.5.\n  Leave it out for the default.");
  EXPECT_EQ(refusal({.start = -1}),
            "start: expected a file number from 0, found -1.\n  Leave it out for the default.");
  EXPECT_EQ(refusal({.depth = 0, .start = 0}), "");
}

TEST(CheckRanges, refuses_what_is_no_finite_number) {
  for (const double value : {kNan, kInfinity, -kInfinity}) {
    EXPECT_NE(refusal({.radius = value}), "") << value;
    EXPECT_NE(refusal({.depth = value}), "") << value;
  }
}

}  // namespace
}  // namespace cairn
