// SPDX-License-Identifier: Apache-2.0
#include "trajectory_inputs.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>

#include "cairn/core/text.h"

namespace cairn::app {
namespace {

namespace fs = std::filesystem;

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

std::string_view explain(AlignmentStatus status) {
  switch (status) {
    case AlignmentStatus::too_few_points:
      return "fewer than 3 pairs of poses do not determine it";
    case AlignmentStatus::one_place:
      return "all poses of one trajectory are at one place";
    case AlignmentStatus::one_line:
      return "all poses of one trajectory lie on one line, so the turn about it is free";
    case AlignmentStatus::mirrored:
      return "the trajectories are mirror images, and several rotations fit equally well";
    case AlignmentStatus::ok:
      break;
  }
  return "";
}

std::string_view word_for(AlignmentStatus status) {
  switch (status) {
    case AlignmentStatus::too_few_points:
      return "too_few_points";
    case AlignmentStatus::one_place:
      return "one_place";
    case AlignmentStatus::one_line:
      return "one_line";
    case AlignmentStatus::mirrored:
      return "mirrored";
    case AlignmentStatus::ok:
      break;
  }
  return "ok";
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

std::string short_name(const std::string& path) {
  const fs::path whole = fs::path(path).lexically_normal();
  const auto named = whole.has_filename() ? whole : whole.parent_path();
  return (named.parent_path().filename() / named.filename()).string();
}

void add_similarity(const Similarity3& map, nlohmann::ordered_json& json) {
  json["scale"] = map.scale;
  json["rotation_xyzw"] = {map.rotation.x(), map.rotation.y(), map.rotation.z(), map.rotation.w()};
  json["translation_m"] = {map.translation.x(), map.translation.y(), map.translation.z()};
}

}  // namespace cairn::app
