// SPDX-License-Identifier: Apache-2.0
#include "cairn/dense/lzf.h"

#include <gtest/gtest.h>

#include <string>

namespace cairn {
namespace {

TEST(Lzf, literals_and_references_by_hand) {
  EXPECT_EQ(decompress_lzf("", 0), "");
  EXPECT_EQ(decompress_lzf(std::string("\x02"
                                       "abc"),
                           3),
            "abc");
  // Three literals; three bytes (1 + 2) from three back (2 + 1).
  EXPECT_EQ(decompress_lzf(std::string("\x02"
                                       "abc"
                                       "\x20\x02"),
                           6),
            "abcabc");
  // One literal; a run that overlaps itself, 7 + 255 + 2 bytes.
  EXPECT_EQ(decompress_lzf(std::string("\0x\xe0\xff\0", 5), 265), std::string(265, 'x'));
}

TEST(Lzf, far_references_have_five_bits_more) {
  std::string packed, text;
  for (int i = 0; i < 10; ++i) {  // 320 literals
    const std::string run(32, static_cast<char>('a' + i));
    packed += '\x1f' + run;
    text += run;
  }
  packed += "\x21\x3f";  // three bytes from 256 + 63 + 1 back
  EXPECT_EQ(decompress_lzf(packed, 323), text + "aaa");
}

TEST(Lzf, what_is_cut_off_or_leads_out_is_refused) {
  const std::string good =
      "\x02"
      "abc"
      "\x20\x02";
  for (std::size_t size : {0UL, 5UL, 7UL, 1UL << 40U}) EXPECT_FALSE(decompress_lzf(good, size)) << size;
  for (std::size_t length = 0; length < good.size(); ++length)
    EXPECT_FALSE(decompress_lzf(good.substr(0, length), 6)) << length;
  EXPECT_FALSE(
      decompress_lzf("\x02"
                     "abc"
                     "\x20\x03",
                     6));  // four back of three
}

}  // namespace
}  // namespace cairn
