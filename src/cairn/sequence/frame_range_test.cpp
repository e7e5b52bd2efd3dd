// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/frame_range.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "cairn/core/random.h"
#include "cairn/testing/core/message_of.h"

namespace cairn {
namespace {

using testkit::message_of;

std::vector<std::int64_t> selected(const std::string& text, std::int64_t count) {
  const FrameRange range = parse_frame_range(text, "--frames");
  std::vector<std::int64_t> positions;
  for (std::int64_t i = 0; i < count; ++i) {
    if (contains(range, i, count)) positions.push_back(i);
  }
  return positions;
}

/// Python's range(count)[begin:end:step], as its reference defines slices ("Sequence types", note 3 to 5).
std::vector<std::int64_t> slice(std::optional<std::int64_t> begin, std::optional<std::int64_t> end,
                                std::int64_t step, std::int64_t count) {
  std::int64_t i = begin.value_or(0), j = end.value_or(count);
  if (i < 0) i += count;
  if (j < 0) j += count;
  std::vector<std::int64_t> positions;
  for (std::int64_t k = std::max<std::int64_t>(i, 0); k < j && k < count; k += step) positions.push_back(k);
  return positions;
}

TEST(FrameRange, examples) {
  using Positions = std::vector<std::int64_t>;
  EXPECT_EQ(selected("1:3", 5), (Positions{1, 2}));
  EXPECT_EQ(selected(":2", 5), (Positions{0, 1}));
  EXPECT_EQ(selected("-2:", 5), (Positions{3, 4}));
  EXPECT_EQ(selected("::2", 5), (Positions{0, 2, 4}));
  EXPECT_EQ(selected("1:-1:2", 6), (Positions{1, 3}));
  EXPECT_EQ(selected(":", 2), (Positions{0, 1}));
  EXPECT_EQ(selected("::", 2), (Positions{0, 1}));
  EXPECT_EQ(selected("-100:100", 2), (Positions{0, 1}));
  EXPECT_EQ(selected("3:1", 5), Positions{});
}

TEST(FrameRange, agrees_with_python_slices) {
  Random random(5);
  const auto bound = [&]() -> std::optional<std::int64_t> {
    if (random.index(4) == 0) return std::nullopt;
    return static_cast<std::int64_t>(random.index(31)) - 15;
  };
  const auto text = [](const std::optional<std::int64_t>& value) {
    return value ? std::to_string(*value) : std::string();
  };
  for (int round = 0; round < 2000; ++round) {
    const auto begin = bound(), end = bound();
    const std::int64_t step = 1 + random.index(5), count = random.index(12);
    const std::string range = text(begin) + ":" + text(end) + ":" + std::to_string(step);
    ASSERT_EQ(selected(range, count), slice(begin, end, step, count)) << range << " of " << count;
  }
}

TEST(FrameRange, what_is_no_slice_is_refused) {
  const std::string expected =
      "--frames: expected A:B or A:B:S with whole numbers, as a Python slice, found '";
  for (const char* text :
       {"", "5", "a:b", "1:2:3:4", "1.5:2", "1 : 2", "1:2:x", "1-5", "99999999999999999999:"}) {
    EXPECT_EQ(message_of([&] { return parse_frame_range(text, "--frames"); }),
              expected + text + "'.\n  For example 0:400 or ::2.");
  }
  for (const char* text : {"::0", "1:5:-1"}) {
    EXPECT_EQ(
        message_of([&] { return parse_frame_range(text, "--without"); }),
        "--without: expected a step of at least 1, found '" + std::string(text) + "'.\n  For example ::2.");
  }
}

}  // namespace
}  // namespace cairn
