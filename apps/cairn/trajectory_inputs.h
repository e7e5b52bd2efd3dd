// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "cairn/geometry/alignment.h"
#include "cairn/sequence/trajectory.h"

namespace cairn::app {

/// What the commands that compare trajectories share.

/// Why no two poses are near in time, and what to do; some lines for stderr. `start_offset_ns` makes the
/// first stamps of their files agree if it is added to the estimate's.
[[nodiscard]] std::string explain_no_pairs(const Trajectory& estimate, const Trajectory& reference,
                                           double max_gap_s, std::int64_t start_offset_ns);
/// Why there is no alignment; part of a sentence, empty for ok.
[[nodiscard]] std::string_view explain(AlignmentStatus status);
/// The same in one word, for JSON.
[[nodiscard]] std::string_view word_for(AlignmentStatus status);
/// Says on stderr where the turn about the main line of the path is hardly determined
/// (Alignment::turn_uncertainty, radians). `name` is the estimate's.
void warn_of_free_turn(std::string_view name, double turn_uncertainty);

/// The last two parts of a path: "run/trajectory.txt".
[[nodiscard]] std::string short_name(const std::string& path);

/// The keys scale, rotation_xyzw and translation_m.
void add_similarity(const Similarity3& map, nlohmann::ordered_json& json);

}  // namespace cairn::app
