// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/frame_range.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "cairn/core/error.h"
#include "cairn/core/text.h"

namespace cairn {
namespace {

std::optional<std::int64_t> parse_bound(std::string_view text, const std::string& whole,
                                        const std::string& option) {
  if (text.empty()) return std::nullopt;
  std::int64_t value = 0;
  if (parse_integer(text, value)) return value;
  throw InputError({option, 0, "A:B or A:B:S with whole numbers, as a Python slice",
                    fmt::format("'{}'", whole), "For example 0:400 or ::2."});
}

}  // namespace

FrameRange parse_frame_range(const std::string& text, const std::string& option) {
  FrameRange range;
  const std::string_view all = text;
  const std::size_t first = all.find(':');
  const std::size_t second = first == std::string::npos ? first : all.find(':', first + 1);
  const bool lone = first == std::string::npos;
  range.begin = parse_bound(lone ? "-" : all.substr(0, first), text, option);
  range.end = parse_bound(all.substr(first + 1, second == std::string::npos ? second : second - first - 1),
                          text, option);
  if (second != std::string::npos) range.step = parse_bound(all.substr(second + 1), text, option).value_or(1);
  if (range.step < 1)
    throw InputError({option, 0, "a step of at least 1", fmt::format("'{}'", text), "For example ::2."});
  return range;
}

bool contains(const FrameRange& range, std::int64_t position, std::int64_t count) {
  const auto absolute = [&](std::int64_t value) {
    return std::clamp<std::int64_t>(value < 0 ? value + count : value, 0, count);
  };
  const std::int64_t begin = absolute(range.begin.value_or(0));
  return position >= begin && position < absolute(range.end.value_or(count)) &&
         (position - begin) % range.step == 0;
}

}  // namespace cairn
