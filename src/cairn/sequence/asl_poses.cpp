// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/asl_poses.h"

#include <fmt/format.h>

namespace cairn {

std::int64_t parse_asl_stamp(const TextFile& file, const TextLine& line, const std::int64_t* before) {
  std::int64_t stamp_ns = 0;
  if (!parse_integer(line.fields[0], stamp_ns)) {
    file.fail(line, "a time stamp in whole nanoseconds", fmt::format("'{}'", line.fields[0]),
              "Correct or delete the line.");
  }
  if (before != nullptr && stamp_ns <= *before) {
    file.fail(line, fmt::format("a time stamp after {}", *before), fmt::format("{}", stamp_ns),
              "Sort the file by time and remove double stamps.");
  }
  return stamp_ns;
}

}  // namespace cairn
