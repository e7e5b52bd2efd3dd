// SPDX-License-Identifier: Apache-2.0
#include "cairn/core/checksum.h"

#include <gtest/gtest.h>

namespace cairn {
namespace {

TEST(Crc32, has_the_standards_check_value) {
  EXPECT_EQ(crc32("123456789"), 0xCBF43926U);
  EXPECT_EQ(crc32(""), 0U);
}

}  // namespace
}  // namespace cairn
