// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/text_table.h"

#include <gtest/gtest.h>

#include "cairn/core/error.h"

namespace cairn {
namespace {

TEST(TextTable, puts_columns_one_below_the_other) {
  EXPECT_EQ(format_table({{"", "pairs", "scale"}, {"a long name", "7", "-"}, {"b", "1000", ""}}),
            "             pairs  scale\n"
            "a long name      7      -\n"
            "b             1000\n");
}

TEST(TextTable, refuses_rows_that_do_not_fit) {
  EXPECT_THROW((void)format_table({}), PreconditionError);
  EXPECT_THROW((void)format_table({{"a", "b"}, {"c"}}), PreconditionError);
}

}  // namespace
}  // namespace cairn
