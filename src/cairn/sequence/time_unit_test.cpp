// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/time_unit.h"

#include <gtest/gtest.h>

namespace cairn {
namespace {

TEST(TimeUnit, stamps_of_each_unit_are_exact_to_the_nanosecond) {
  struct Case {
    TimeUnit unit;
    const char* text;
    std::int64_t stamp_ns;
  };
  const Case cases[] = {
      {TimeUnit::second, "1403636579.763555584", 1'403'636'579'763'555'584},
      {TimeUnit::millisecond, "1403636579763.555584", 1'403'636'579'763'555'584},
      {TimeUnit::millisecond, "12", 12'000'000},
      {TimeUnit::millisecond, "0.0000006", 1},
      {TimeUnit::microsecond, "1403636579763555.584", 1'403'636'579'763'555'584},
      {TimeUnit::microsecond, "1403636579763555", 1'403'636'579'763'555'000},
      {TimeUnit::nanosecond, "1403636579763555584", 1'403'636'579'763'555'584},
      {TimeUnit::nanosecond, "1403636579763555584.000000", 1'403'636'579'763'555'584},
      {TimeUnit::nanosecond, "-5", -5},
      {TimeUnit::nanosecond, "1e9", 1'000'000'000},
  };
  for (const Case& each : cases) {
    std::int64_t stamp_ns = 0;
    ASSERT_TRUE(parse_stamp_in(each.unit, each.text, stamp_ns)) << each.text;
    EXPECT_EQ(stamp_ns, each.stamp_ns) << each.text;
  }
}

TEST(TimeUnit, what_is_no_stamp_is_refused) {
  std::int64_t stamp_ns = 0;
  for (const char* text :
       {"", ".", "x", "1.5", "1e-3", "nan", "99999999999999999999", "1403636579763555584,0"})
    EXPECT_FALSE(parse_stamp_in(TimeUnit::nanosecond, text, stamp_ns)) << text;
  EXPECT_FALSE(parse_stamp_in(TimeUnit::millisecond, "9999999999999999", stamp_ns));
}

TEST(TimeUnit, is_told_by_the_size_of_the_stamps) {
  EXPECT_EQ(infer_time_unit({"1403636579.76", "1403636579.81"}), TimeUnit::second);
  EXPECT_EQ(infer_time_unit({"1403636579763", "1403636579813"}), TimeUnit::millisecond);
  EXPECT_EQ(infer_time_unit({"1403636579763555", "1403636579813555"}), TimeUnit::microsecond);
  EXPECT_EQ(infer_time_unit({"1403636579763555584.000000"}), TimeUnit::nanosecond);
  EXPECT_EQ(infer_time_unit({"0", "50000000", "100000000"}), TimeUnit::nanosecond);  // of a clock from zero
  EXPECT_EQ(infer_time_unit({"0", "1", "2"}), TimeUnit::second);
  EXPECT_EQ(infer_time_unit({"0.5", "3600.5"}), TimeUnit::second);
  EXPECT_EQ(infer_time_unit({}), TimeUnit::second);
}

TEST(TimeUnit, seconds_are_written_with_the_decimals_that_count) {
  EXPECT_EQ(format_seconds(-1'317'042'145'594'360'375), "-1317042145.594360375");
  EXPECT_EQ(format_seconds(-250'000'000), "-0.25");
  EXPECT_EQ(format_seconds(20'000'000'000), "20.0");
  EXPECT_EQ(format_seconds(0), "0.0");
}

}  // namespace
}  // namespace cairn
