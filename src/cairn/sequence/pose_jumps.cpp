// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/pose_jumps.h"

#include <fmt/format.h>

#include "cairn/core/text.h"

namespace cairn {

bool is_jump(double metres, double seconds) {
  constexpr double kFastest = 150, kShortest = 1;  // m/s, m
  return metres >= kShortest && metres > kFastest * seconds;
}

std::string describe_jump(double metres, double seconds, const std::string& stamp) {
  return fmt::format("the position jumps by {:.6g} m within {:.6g} s, at {}", metres, seconds, stamp);
}

std::string describe_jumps(const std::string& first_jump, int count) {
  return fmt::format("{}, faster than any vehicle; {} such jump{}. Check the positions there.", first_jump,
                     count, count == 1 ? "" : "s");
}

void warn_of_jumps(const std::string& source, const Sequence& sequence, GivenPoses& given) {
  int count = 0;
  std::string first;
  for (std::size_t i = 1; i < given.frames.size(); ++i) {
    if (!given.frames[i - 1] || !given.frames[i]) continue;
    const FrameFiles &before = sequence.frames[i - 1], &frame = sequence.frames[i];
    const double seconds =
        1e-9 * (static_cast<double>(frame.stamp_ns) - static_cast<double>(before.stamp_ns));
    const double metres =
        (given.frames[i]->world_from_camera.translation - given.frames[i - 1]->world_from_camera.translation)
            .norm();
    if (!is_jump(metres, seconds)) continue;
    if (count++ == 0) {
      first = fmt::format("{}: frame {}: {}", source, frame.number,
                          describe_jump(metres, seconds, format_stamp(frame.stamp_ns)));
    }
  }
  if (count > 0) given.warnings.push_back(describe_jumps(first, count));
}

}  // namespace cairn
