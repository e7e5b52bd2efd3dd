// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "cairn/sequence/trajectory.h"

namespace cairn::app {

/// What the commands that compare trajectories share.

/// Why no two poses are near in time, and what to do; some lines for stderr. `start_offset_ns` makes the
/// first stamps of their files agree if it is added to the estimate's.
[[nodiscard]] std::string explain_no_pairs(const Trajectory& estimate, const Trajectory& reference,
                                           double max_gap_s, std::int64_t start_offset_ns);
/// Says on stderr where the turn about the main line of the path is hardly determined
/// (Alignment::turn_uncertainty, radians). `name` is the estimate's.
void warn_of_free_turn(std::string_view name, double turn_uncertainty);

}  // namespace cairn::app
