// SPDX-License-Identifier: Apache-2.0
#include "cairn/core/checksum.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <string_view>

namespace cairn {
namespace {

TEST(Crc32, has_the_standards_check_value) {
  EXPECT_EQ(crc32("123456789"), 0xCBF43926U);
  EXPECT_EQ(crc32(""), 0U);
}

TEST(Crc32, does_not_depend_on_the_pieces) {
  const std::string bytes("piece\0by \xFFpiece", 15);
  for (std::size_t cut = 0; cut <= bytes.size(); ++cut) {
    Crc32 begun;
    begun.add(std::string_view(bytes).substr(0, cut));
    Crc32 resumed(begun.value());
    resumed.add(std::string_view(bytes).substr(cut));
    EXPECT_EQ(resumed.value(), crc32(bytes)) << cut;
  }
}

TEST(Crc32, keeps_its_value_if_nothing_is_added) {
  Crc32 checksum;
  checksum.add("123456789");
  checksum.add(std::string_view());  // without an address
  EXPECT_EQ(checksum.value(), 0xCBF43926U);
}

}  // namespace
}  // namespace cairn
