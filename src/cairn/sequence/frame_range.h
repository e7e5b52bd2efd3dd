// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace cairn {

/// Describes a half-open range of frames by position, as a Python slice A:B[:S]; negative numbers count from
/// the end.
struct FrameRange {
  std::optional<std::int64_t> begin, end;
  std::int64_t step = 1;  ///< at least 1
};

/// Parses a range: "10:200", ":50", "::2". Throws InputError that names `option` otherwise.
[[nodiscard]] FrameRange parse_frame_range(const std::string& text, const std::string& option);

/// Tells whether `position` in [0, count) is among those that Python's range(count)[A:B:S] keeps.
[[nodiscard]] bool contains(const FrameRange& range, std::int64_t position, std::int64_t count);

}  // namespace cairn
