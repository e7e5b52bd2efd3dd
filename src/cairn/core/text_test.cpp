// SPDX-License-Identifier: Apache-2.0
#include "cairn/core/text.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>

#include "cairn/core/error.h"
#include "cairn/testing/core/temporary_folder.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;

struct NumberCase {
  std::string text;
  bool good;
  double value;
};

TEST(LowerCase, changes_the_letters_of_ascii_alone) {
  EXPECT_EQ(lower_case("AZ az_@[09"), "az az_@[09");
  EXPECT_EQ(lower_case("\xC3\x84"), "\xC3\x84");  // a letter of two bytes
  EXPECT_EQ(lower_case(""), "");
}

TEST(ParseNumber, takes_whole_finite_numbers_and_nothing_else) {
  const NumberCase cases[] = {
      {"1", true, 1},      {"-1.5", true, -1.5}, {"+2", true, 2},         {".5", true, 0.5},
      {"5.", true, 5},     {"1e-3", true, 1e-3}, {"-2.5E+2", true, -250}, {"0", true, 0},
      {"", false, 0},      {"+", false, 0},      {"+-1", false, 0},       {"--1", false, 0},
      {"1,5", false, 0},   {"1.5x", false, 0},   {" 1", false, 0},        {"nan", false, 0},
      {"inf", false, 0},   {"-inf", false, 0},   {"1e999", false, 0},     {"0x10", false, 0},
      {"1.2.3", false, 0}, {"one", false, 0},    {"1e", false, 0},
  };
  for (const auto& [text, good, expected] : cases) {
    double value = 0;
    EXPECT_EQ(parse_number(text, value), good) << text;
    if (good) {
      EXPECT_EQ(value, expected) << text;
    }
  }
}

TEST(ParseInteger, takes_whole_integers_and_nothing_else) {
  std::int64_t value = 0;
  EXPECT_TRUE(parse_integer("-12", value));
  EXPECT_EQ(value, -12);
  for (const char* text : {"", "1.0", "1e3", "9223372036854775808", "x", " 1"})
    EXPECT_FALSE(parse_integer(text, value)) << text;
}

struct StampCase {
  std::string text;
  bool good;
  std::int64_t stamp_ns;
};

TEST(ParseStamp, is_exact_to_the_nanosecond) {
  const StampCase cases[] = {
      {"1305031453.359684", true, 1'305'031'453'359'684'000},
      {"1305031453.123456789", true, 1'305'031'453'123'456'789},
      {"0.1234567894", true, 123'456'789},
      {"0.9999999996", true, 1'000'000'000},
      {"7", true, 7'000'000'000},
      {"7.", true, 7'000'000'000},
      {".25", true, 250'000'000},
      {"-0.5", true, -500'000'000},
      {"1.5e2", true, 150'000'000'000},
      {"1.403636579763555e9", true, 1'403'636'579'763'555'072},  // by way of a double
      {"", false, 0},
      {"1.2.3", false, 0},
      {"12:30", false, 0},
      {"99999999999", false, 0},
      {"1e30", false, 0},
      {"nan", false, 0},
  };
  for (const auto& [text, good, expected] : cases) {
    std::int64_t stamp_ns = 0;
    EXPECT_EQ(parse_stamp(text, stamp_ns), good) << text;
    if (good) {
      EXPECT_EQ(stamp_ns, expected) << text;
    }
  }
}

TEST(FormatStamp, is_the_inverse_of_parsing) {
  EXPECT_EQ(format_stamp(1'305'031'453'359'684'000), "1305031453.359684000");
  EXPECT_EQ(format_stamp(-1), "-0.000000001");
  EXPECT_EQ(format_stamp(std::numeric_limits<std::int64_t>::min()), "-9223372036.854775808");
  std::int64_t stamp_ns = 0;
  ASSERT_TRUE(parse_stamp(format_stamp(1'403'636'579'763'555'584), stamp_ns));
  EXPECT_EQ(stamp_ns, 1'403'636'579'763'555'584);
}

TEST(NearestName, finds_the_smallest_edit_distance) {
  EXPECT_EQ(nearest_name("simulat", {"slam", "simulate", "info"}), "simulate");
  EXPECT_EQ(nearest_name("salm", {"slam", "simulate", "info"}), "slam");
  EXPECT_EQ(nearest_name("", {"abc", "a"}), "a");
  EXPECT_THROW((void)nearest_name("a", {}), PreconditionError);
}

class TextFileTest : public testing::Test {
 protected:
  TextFile open(std::string_view contents, Separator separator = Separator::blanks) const {
    return TextFile(folder_.write("text.txt", contents), separator);
  }

  /// What the exception of `action` says, without the path.
  template <class Action>
  std::string message(const Action& action) const {
    try {
      action();
    } catch (const InputError& error) {
      return std::string(error.what()).substr(path_.string().size());
    }
    return "no exception";
  }

 private:
  const testkit::TemporaryFolder folder_;
  const fs::path path_ = folder_ / "text.txt";
};

TEST_F(TextFileTest, splits_lines_into_fields) {
  const TextFile file = open("# head\n1 2\t3\r\n\n   \n  4 # rest\nlast");
  ASSERT_EQ(file.lines().size(), 3U);
  EXPECT_EQ(file.lines()[0].number, 2);
  EXPECT_EQ(file.lines()[0].fields, (std::vector<std::string_view>{"1", "2", "3"}));
  EXPECT_EQ(file.lines()[1].number, 5);
  EXPECT_EQ(file.lines()[1].fields, (std::vector<std::string_view>{"4"}));
  EXPECT_EQ(file.lines()[2].fields, (std::vector<std::string_view>{"last"}));
}

TEST_F(TextFileTest, splits_lines_at_commas) {
  const TextFile file = open("#t,name\r\n1, a b ,\t3\r\n\n  \n,# rest\nlast\n", Separator::commas);
  ASSERT_EQ(file.lines().size(), 3U);
  EXPECT_EQ(file.lines()[0].number, 2);
  EXPECT_EQ(file.lines()[0].fields, (std::vector<std::string_view>{"1", "a b", "3"}));
  EXPECT_EQ(file.lines()[1].fields, (std::vector<std::string_view>{"", ""}));
  EXPECT_EQ(file.lines()[2].fields, (std::vector<std::string_view>{"last"}));
}

TEST_F(TextFileTest, may_be_empty) {
  EXPECT_TRUE(open("").lines().empty());
  EXPECT_TRUE(open("\n\n").lines().empty());
}

TEST_F(TextFileTest, passes_over_a_byte_order_mark) {
  EXPECT_EQ(open("\xEF\xBB\xBF"
                 "1 2\n")
                .lines()
                .at(0)
                .fields[0],
            "1");
}

TEST_F(TextFileTest, reads_numbers) {
  const TextFile file = open("1.5 -3\n");
  EXPECT_EQ(file.number(file.lines()[0], 0, "x"), 1.5);
  EXPECT_EQ(file.integer(file.lines()[0], 1, "n"), -3);
}

TEST_F(TextFileTest, names_the_line_of_what_is_no_number) {
  const TextFile file = open("1\n2 x 1.5\n");
  const TextLine& line = file.lines()[1];
  EXPECT_EQ(message([&] { (void)file.number(line, 1, "tx"); }),
            ":2: expected a number for tx, found 'x'.\n  Correct or delete the line.");
  EXPECT_EQ(message([&] { (void)file.number(line, 3, "tx"); }),
            ":2: expected a number for tx, found nothing.\n  Correct or delete the line.");
  EXPECT_EQ(message([&] { (void)file.integer(line, 2, "id"); }),
            ":2: expected a whole number for id, found '1.5'.\n  Correct or delete the line.");
}

TEST_F(TextFileTest, names_the_line_with_a_wrong_number_of_fields) {
  const TextFile file = open("1 2 3\n");
  EXPECT_NO_THROW(file.expect_fields(file.lines()[0], 3, "a b c"));
  EXPECT_EQ(message([&] { file.expect_fields(file.lines()[0], 2, "a b"); }),
            ":1: expected 2 values (a b), found 3.\n  Correct or delete the line.");
}

/// The names in natural order.
std::vector<std::string> sorted(std::vector<std::string> names) {
  std::sort(names.begin(), names.end(), comes_naturally_before);
  return names;
}

using Names = std::vector<std::string>;

TEST(NaturalOrder, counts_as_people_do) {
  EXPECT_EQ(sorted({"10.png", "9.png", "1.png", "100.png", "11.png", "2.png", "0.png"}),
            (Names{"0.png", "1.png", "2.png", "9.png", "10.png", "11.png", "100.png"}));
}

TEST(NaturalOrder, compares_every_run_of_digits) {
  EXPECT_EQ(sorted({"cam1_0_1.png", "cam0_12_3.png", "cam0_2_10.png", "cam0_2_9.png", "cam0_12_20.png"}),
            (Names{"cam0_2_9.png", "cam0_2_10.png", "cam0_12_3.png", "cam0_12_20.png", "cam1_0_1.png"}));
}

TEST(NaturalOrder, takes_numbers_that_no_integer_holds) {
  EXPECT_EQ(
      sorted({"20000000000000000000000000.png", "9999999999999999999.png", "1000000000000000000000.png"}),
      (Names{"9999999999999999999.png", "1000000000000000000000.png", "20000000000000000000000000.png"}));
}

TEST(NaturalOrder, breaks_ties_by_leading_zeros) {
  EXPECT_EQ(sorted({"1.png", "2.png", "01.png", "001.png", "000002.png"}),
            (Names{"001.png", "01.png", "1.png", "000002.png", "2.png"}));
  EXPECT_EQ(sorted({"0", "00"}), (Names{"00", "0"}));
  EXPECT_EQ(sorted({"0.png", "00.png", "1_01.png", "1_1.png", "01_1.png"}),
            (Names{"00.png", "0.png", "01_1.png", "1_01.png", "1_1.png"}));
  EXPECT_FALSE(comes_naturally_before("7", "7"));
}

TEST(NaturalOrder, puts_the_shorter_of_two_names_first) {
  EXPECT_EQ(sorted({"a1b", "a1", "a", "", "a10"}), (Names{"", "a", "a1", "a1b", "a10"}));
}

TEST(NaturalOrder, compares_other_bytes_without_sign) {
  EXPECT_TRUE(comes_naturally_before("z", "\xC3\xA4"));
  EXPECT_FALSE(comes_naturally_before("\xC3\xA4", "z"));
}

TEST(EditDistance, counts_letters) {
  EXPECT_EQ(edit_distance("", ""), 0U);
  EXPECT_EQ(edit_distance("abc", ""), 3U);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);
  EXPECT_EQ(edit_distance("--thread", "--threads"), 1U);
}

}  // namespace
}  // namespace cairn
