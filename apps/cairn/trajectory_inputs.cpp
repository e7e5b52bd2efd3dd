// SPDX-License-Identifier: Apache-2.0
#include "trajectory_inputs.h"

#include <fmt/format.h>

#include <cstdio>
#include <numbers>

#include "cairn/core/text.h"

namespace cairn::app {
namespace {

std::string time_range(const Trajectory& trajectory) {
  return fmt::format("{} to {} s, {} poses", format_stamp(trajectory.front().stamp_ns),
                     format_stamp(trajectory.back().stamp_ns), trajectory.size());
}

}  // namespace

std::string explain_no_pairs(const Trajectory& estimate, const Trajectory& reference, double max_gap_s,
                             std::int64_t start_offset_ns) {
  return fmt::format(
      "no pose of EST is within {} s of a pose of REF.\n  EST {}\n  REF {}\n"
      "  If the times overlap, raise --max-gap; if only the clocks differ, add --offset {}, or --offset "
      "start, "
      "which align\n  the first stamps; else the files do not belong together.",
      max_gap_s, time_range(estimate), time_range(reference), format_seconds(start_offset_ns));
}

void warn_of_free_turn(std::string_view name, double turn_uncertainty) {
  constexpr double kFreeDeg = 10;
  const double degrees = 180.0 / std::numbers::pi * turn_uncertainty;
  if (degrees <= kFreeDeg) return;
  fmt::print(stderr,
             "cairn: {}: for residuals of this size the poses lie too near to one line: the turn about it, "
             "and with it\n"
             "  every rotation after the alignment, is good to about {:.0f} deg only.\n",
             name, degrees);
}

}  // namespace cairn::app
