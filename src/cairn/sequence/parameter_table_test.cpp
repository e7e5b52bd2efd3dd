// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/parameter_table.h"

#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

namespace cairn {
namespace {

TEST(FormatAsText, has_columns) {
  const std::vector<ParameterRow> rows{{"radius_px", "0.5", "pixels above 0", "A radius."},
                                       {"count", "", "a number", "How many."}};
  EXPECT_EQ(format_as_text(rows),
            "  radius_px  0.5  pixels above 0. A radius.\n"
            "  count           a number. How many.\n");
  EXPECT_EQ(format_as_text({}), "");
}

/// Every word stays, in its order, in its column.
TEST(FormatAsText, breaks_long_lines_at_blanks) {
  std::string meaning;
  for (int i = 0; i < 60; ++i) meaning += "word" + std::to_string(i) + (i < 59 ? " " : "");
  std::istringstream lines(format_as_text(std::vector<ParameterRow>{{"name", "7", "text", meaning}}));
  std::string joined;
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    EXPECT_LE(line.size(), 100U);
    EXPECT_EQ(line.substr(0, 11), count == 0 ? "  name  7  " : std::string(11, ' '));
    joined += (count > 0 ? " " : "") + line.substr(11);
  }
  EXPECT_EQ(joined, "text. " + meaning);
  EXPECT_EQ(count, 5);
}

TEST(FormatAsText, leaves_a_word_whole_that_is_longer_than_a_line) {
  const std::string word(150, 'w');
  EXPECT_EQ(format_as_text(std::vector<ParameterRow>{{"a", "1", "x", word}}),
            "  a  1  x.\n        " + word + "\n");
}

TEST(FormatAsMarkdown, has_a_line_for_each_parameter) {
  const std::vector<ParameterRow> rows{{"radius_px", "0.5", "pixels above 0", "A radius."},
                                       {"count", "", "a number", "How many."}};
  EXPECT_EQ(format_as_markdown(rows),
            "| parameter | default | accepts | meaning |\n"
            "|---|---:|---|---|\n"
            "| `radius_px` | 0.5 | pixels above 0 | A radius. |\n"
            "| `count` |  | a number | How many. |\n");
}

}  // namespace
}  // namespace cairn
