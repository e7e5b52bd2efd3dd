// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/trajectory_words.h"

#include <fmt/format.h>

#include <filesystem>

namespace cairn {

std::string short_name(const std::string& path) {
  const auto whole = std::filesystem::path(path).lexically_normal();
  const auto named = whole.has_filename() ? whole : whole.parent_path();
  return (named.parent_path().filename() / named.filename()).string();
}

std::string_view name_of(AlignmentMode alignment) {
  switch (alignment) {
    case AlignmentMode::none:
      return "none";
    case AlignmentMode::sim3:
      return "sim3";
    case AlignmentMode::se3:
      break;
  }
  return "se3";
}

std::string_view name_of(RpeUnit unit) {
  switch (unit) {
    case RpeUnit::metres:
      return "metres";
    case RpeUnit::seconds:
      return "seconds";
    case RpeUnit::frames:
      break;
  }
  return "frames";
}

std::string name_of(const RpeOptions& options) {
  if (options.unit == RpeUnit::frames)
    return fmt::format("{} frame{}", options.delta, options.delta == 1 ? "" : "s");
  return fmt::format("{} {}", options.delta, options.unit == RpeUnit::metres ? "m" : "s");
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

std::string_view word_for(EvaluationStatus status) {
  switch (status) {
    case EvaluationStatus::no_pairs:
      return "no_pairs";
    case EvaluationStatus::not_alignable:
      return "not_alignable";
    case EvaluationStatus::ok:
      break;
  }
  return "ok";
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

ShownUnit unit_for(double largest_error_m) {
  constexpr double kFarM = 10;
  return largest_error_m < kFarM ? ShownUnit{"cm", 100} : ShownUnit{"m", 1};
}

}  // namespace cairn
