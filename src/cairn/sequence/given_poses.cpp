// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/given_poses.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "cairn/core/error.h"
#include "cairn/geometry/covariance.h"
#include "cairn/sequence/geodetic.h"
#include "cairn/sequence/pose_jumps.h"
#include "cairn/sequence/recorded_poses.h"
#include "cairn/sequence/time_unit.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;

/// Elsewhere frames and the sequence's own poses have the same stamps, made from numbers.
bool has_clock(const Sequence& sequence) {
  return sequence.format == "TUM" || sequence.format == "EuRoC";
}

void check_options(const GivenPosesOptions& options) {
  constexpr double kLargest = 9e9;  // seconds; the stamps' own range
  const auto check = [](bool holds, const char* name, const char* expected, double found) {
    if (!holds) throw InputError({name, 0, expected, fmt::format("{}", found), "Mend the value."});
  };
  check(std::abs(options.time_offset_s) <= kLargest, "time_offset_s", "seconds from -9e9 to 9e9",
        options.time_offset_s);
  check(options.max_gap_s >= 0 && options.max_gap_s <= kLargest, "max_gap_s", "seconds from 0 to 9e9",
        options.max_gap_s);
  if (!options.origin) return;
  check(std::abs(options.origin->latitude_deg) <= 90, "origin", "a latitude from -90 to 90 degrees",
        options.origin->latitude_deg);
  check(std::isfinite(options.origin->longitude_deg), "origin", "a finite longitude",
        options.origin->longitude_deg);
  check(std::isfinite(options.origin->height_m), "origin", "a finite height", options.origin->height_m);
}

RecordedPoses own_poses(const Sequence& sequence) {
  if (sequence.truth) {
    RecordedPoses recorded = poses_of_trajectory(*sequence.truth);
    recorded.source = sequence.folder;
    recorded.format = "truth";
    return recorded;
  }
  if (const auto oxts = oxts_in(sequence.folder)) return read_oxts(*oxts);
  throw InputError({sequence.folder.string(), 0, "poses", "a sequence that carries none",
                    "Give --poses FILE (docs/poses.md)."});
}

/// How far in time a pose may be from a frame.
struct TimeRules {
  std::uint64_t max_gap_ns = 0;    ///< between the poses before and after
  std::uint64_t tolerance_ns = 0;  ///< to the nearest pose, whatever the gap
};

TimeRules rules_for(const Sequence& sequence, const RecordedPoses& recorded,
                    const GivenPosesOptions& options) {
  constexpr std::uint64_t kRoundedStampNs = 1'000'000;
  const bool exact = recorded.key != PoseKey::stamp || (recorded.format == "truth" && !has_clock(sequence));
  if (!exact) return {static_cast<std::uint64_t>(std::llround(options.max_gap_s * 1e9)), kRoundedStampNs};
  if (options.time_offset_s == 0 && !options.align_first_stamps) return {};
  throw InputError({"time_offset_s", 0, "0, as these poses belong to frames by their numbers",
                    options.align_first_stamps ? "start" : fmt::format("{}", options.time_offset_s),
                    "Leave it out."});
}

/// a + b, or the int64 nearest to it: stamps that far off are refused when they are shifted.
std::int64_t saturated_sum(std::int64_t a, std::int64_t b) {
  std::int64_t sum = 0;
  if (!__builtin_add_overflow(a, b, &sum)) return sum;
  return b < 0 ? std::numeric_limits<std::int64_t>::min() : std::numeric_limits<std::int64_t>::max();
}

/// From the first pose's stamp to that of the recording's first frame.
std::int64_t offset_of_starts(const Sequence& sequence, const RecordedPoses& recorded) {
  const std::int64_t frame = sequence.first_stamp_ns.value_or(sequence.frames.front().stamp_ns);
  return saturated_sum(frame, -recorded.first_key.value_or(recorded.poses.front().key));
}

/// Returns the offset that was added, nanoseconds.
std::int64_t shift_stamps(const Sequence& sequence, const GivenPosesOptions& options,
                          RecordedPoses& recorded) {
  const bool by_starts = options.align_first_stamps;
  const std::int64_t offset_ns =
      by_starts ? offset_of_starts(sequence, recorded) : std::llround(options.time_offset_s * 1e9);
  for (RecordedPose& pose : recorded.poses) {
    if (!__builtin_add_overflow(pose.key, offset_ns, &pose.key)) continue;
    throw InputError({"time_offset_s", 0, "an offset that leaves the stamps within 292 years of 1970",
                      fmt::format("{}", options.time_offset_s), "Mend the value."});
  }
  if (recorded.first_key) recorded.first_key = saturated_sum(*recorded.first_key, offset_ns);
  if (by_starts)
    recorded.warnings.push_back(fmt::format("{}: the first stamps are aligned by an offset of {} s.",
                                            recorded.source.string(), format_seconds(offset_ns)));
  return offset_ns;
}

std::int64_t key_of(const FrameFiles& files, PoseKey key) {
  switch (key) {
    case PoseKey::stamp:
      return files.stamp_ns;
    case PoseKey::number:
      return files.number;
    case PoseKey::position:
      break;
  }
  return files.position;
}

/// Between which two recorded poses a frame lies; of one pose both are the same.
struct PoseSpan {
  std::size_t before = 0, after = 0;
  double weight_after = 0;
};

/// b - a for a <= b, where an int64 might overflow.
std::uint64_t distance(std::int64_t a, std::int64_t b) {
  return static_cast<std::uint64_t>(b) - static_cast<std::uint64_t>(a);
}

std::optional<PoseSpan> find_span(const std::vector<RecordedPose>& poses, std::int64_t key,
                                  const TimeRules& rules) {
  const auto found = std::lower_bound(poses.begin(), poses.end(), key,
                                      [](const RecordedPose& pose, std::int64_t k) { return pose.key < k; });
  const auto after = static_cast<std::size_t>(found - poses.begin());
  if (found != poses.end() && found->key == key) return PoseSpan{after, after, 0};
  const auto alone = [&](std::size_t i, std::uint64_t away) {
    return away <= rules.tolerance_ns ? std::optional(PoseSpan{i, i, 0}) : std::nullopt;
  };
  if (found == poses.begin()) return alone(0, distance(key, poses.front().key));
  if (found == poses.end()) return alone(poses.size() - 1, distance(poses.back().key, key));
  const std::uint64_t from_before = distance(poses[after - 1].key, key), to_after = distance(key, found->key);
  const std::uint64_t gap = distance(poses[after - 1].key, found->key);
  if (gap <= rules.max_gap_ns)
    return PoseSpan{after - 1, after, static_cast<double>(from_before) / static_cast<double>(gap)};
  return from_before <= to_after ? alone(after - 1, from_before) : alone(after, to_after);
}

using PoseSpans = std::vector<std::optional<PoseSpan>>;

/// What to do where the poses are of other times than the frames. `shifted_s` was added to their stamps.
std::string remedy_for_times(const Sequence& sequence, const RecordedPoses& recorded, double shifted_s) {
  const auto& frames = sequence.frames;
  const auto& poses = recorded.poses;
  if (poses.front().key <= frames.back().stamp_ns && poses.back().key >= frames.front().stamp_ns)
    return "The times overlap: raise --pose-gap, or check that the poses belong to this sequence.";
  const std::int64_t offset_ns =
      saturated_sum(offset_of_starts(sequence, recorded), std::llround(shifted_s * 1e9));
  return fmt::format(
      "If only the clocks differ, add --pose-offset {}, or --pose-offset start, which align the first "
      "stamps; "
      "else check that the poses belong to this sequence and share its clock.",
      format_seconds(offset_ns));
}

[[noreturn]] void fail_without_poses(const Sequence& sequence, const RecordedPoses& recorded,
                                     const GivenPosesOptions& options, double shifted_s) {
  if (recorded.key == PoseKey::number)
    throw InputError({recorded.source.string(), 0, "poses of the sequence's frame numbers", "none",
                      "Check that the poses belong to this sequence."});
  throw InputError(
      {recorded.source.string(), 0,
       fmt::format("poses within the time of the frames, {} to {}, at most {} s apart",
                   format_stamp(sequence.frames.front().stamp_ns),
                   format_stamp(sequence.frames.back().stamp_ns), options.max_gap_s),
       fmt::format("{} from {} to {}", recorded.poses.size(), format_stamp(recorded.poses.front().key),
                   format_stamp(recorded.poses.back().key)),
       remedy_for_times(sequence, recorded, shifted_s)});
}

PoseSpans spans_of_frames(const Sequence& sequence, const RecordedPoses& recorded,
                          const GivenPosesOptions& options, double shifted_s) {
  const TimeRules rules = rules_for(sequence, recorded, options);
  PoseSpans spans;
  for (const FrameFiles& files : sequence.frames)
    spans.push_back(find_span(recorded.poses, key_of(files, recorded.key), rules));
  const bool has_some =
      std::any_of(spans.begin(), spans.end(), [](const auto& span) { return span.has_value(); });
  if (!has_some) fail_without_poses(sequence, recorded, options, shifted_s);
  return spans;
}

/// A file of KITTI has a line for each frame of the recording.
void expect_one_for_each_frame(const Sequence& sequence, const RecordedPoses& recorded) {
  if (recorded.key != PoseKey::position) return;
  if (static_cast<std::int64_t>(recorded.poses.size()) == sequence.listed) return;
  throw InputError(
      {recorded.source.string(), 0,
       fmt::format("{} poses, one for each frame of {}", sequence.listed, sequence.folder.string()),
       fmt::format("{}", recorded.poses.size()),
       "Add or delete lines, or give the poses with time stamps (TUM format)."});
}

GeodeticOrigin origin_at(const Eigen::Vector3d& place) {
  return {place.x(), place.y(), place.z()};
}

std::size_t first_used(const PoseSpans& spans) {
  const auto first =
      std::find_if(spans.begin(), spans.end(), [](const auto& span) { return span.has_value(); });
  return (*first)->before;
}

/// Where the camera sits on what the poses are of.
Rigid3 subject_from_camera(const Sequence& sequence, const RecordedPoses& recorded) {
  const Calibration& calibration = sequence.calibration;
  const bool is_open = recorded.subject == PoseSubject::not_stated;
  if (recorded.subject == PoseSubject::camera || (is_open && !calibration.body_from_camera)) return {};
  if (calibration.body_from_camera)
    return body_from_loaded_camera(calibration, *calibration.body_from_camera);
  const bool is_down = recorded.subject == PoseSubject::body_forward_right_down;
  throw InputError(
      {sequence.calibration_source, 0,
       fmt::format(
           "'body: {{body_from_camera: ...}}', lever arm and boresight of the camera, as the poses ({}) are "
           "of a body",
           recorded.format),
       "none",
       fmt::format(
           "Add it to camera.yaml. For a camera at the body's origin that looks forward: body: "
           "{{body_from_camera: {{translation: [0, 0, 0], quaternion_xyzw: {}}}}} (body: x forward, {}).",
           is_down ? "[0.5, 0.5, 0.5, 0.5]" : "[-0.5, 0.5, -0.5, 0.5]",
           is_down ? "y right, z down" : "y left, z up")});
}

void warn_of_open_subject(const Sequence& sequence, const RecordedPoses& recorded, GivenPoses& given) {
  if (recorded.subject != PoseSubject::not_stated) return;
  const bool is_of_body = sequence.calibration.body_from_camera.has_value();
  given.warnings.push_back(fmt::format(
      "{}: its columns do not say whose poses they are: taken as {}, as the calibration {} 'body: "
      "{{body_from_camera: ...}}'.",
      recorded.source.string(), is_of_body ? "the body's" : "the camera's", is_of_body ? "has" : "has no"));
}

RecordedPose interpolate(const RecordedPose& a, const RecordedPose& b, double t) {
  RecordedPose pose;
  pose.place = (1 - t) * a.place + t * b.place;
  pose.rotation = a.rotation.slerp(t, b.rotation).normalized();
  pose.place_covariance = (1 - t) * a.place_covariance + t * b.place_covariance;
  pose.rotation_covariance = (1 - t) * a.rotation_covariance + t * b.rotation_covariance;
  return pose;
}

RecordedPose pose_at(const PoseSpan& span, const RecordedPoses& recorded) {
  if (span.before == span.after) return recorded.poses[span.before];
  return interpolate(recorded.poses[span.before], recorded.poses[span.after], span.weight_after);
}

/// The centre's error is c = p + w x a, with the errors p of the body's place and w of its rotation, which
/// are independent, and the lever arm a in the world's axes; w is the camera's as well.
PoseUncertainty uncertainty_at(const RecordedPose& body, const Eigen::Vector3d& arm_in_world) {
  const Eigen::Matrix3d by_rotation = -skew(arm_in_world);
  PoseUncertainty uncertainty;
  uncertainty.rotation = body.rotation_covariance;
  uncertainty.position_rotation = by_rotation * body.rotation_covariance;
  uncertainty.position = body.place_covariance + propagate_covariance(by_rotation, body.rotation_covariance);
  return uncertainty;
}

GivenPose place_camera(const RecordedPose& body, const Rigid3& body_from_camera, bool has_uncertainty) {
  GivenPose pose;
  pose.world_from_camera = WorldFromCamera(Rigid3{body.rotation, body.place} * body_from_camera);
  if (has_uncertainty) pose.uncertainty = uncertainty_at(body, body.rotation * body_from_camera.translation);
  return pose;
}

GivenPoses read_checked(const Sequence& sequence, const GivenPosesOptions& options) {
  RecordedPoses recorded =
      options.path.empty() ? own_poses(sequence) : read_recorded_poses(options.path, !has_clock(sequence));
  const Rigid3 body_from_camera = subject_from_camera(sequence, recorded);
  expect_one_for_each_frame(sequence, recorded);
  GivenPoses given;
  if (recorded.key == PoseKey::stamp)
    given.time_offset_s = 1e-9 * static_cast<double>(shift_stamps(sequence, options, recorded));
  const PoseSpans spans = spans_of_frames(sequence, recorded, options, given.time_offset_s);
  given.source = recorded.source;
  given.subject_from_camera = body_from_camera;
  given.format = recorded.format;
  given.warnings = recorded.warnings;
  warn_of_open_subject(sequence, recorded, given);
  if (recorded.geodetic) {
    given.origin = options.origin.value_or(origin_at(recorded.poses[first_used(spans)].place));
    move_to_origin(*given.origin, recorded);
  }
  for (const auto& span : spans) {
    given.frames.emplace_back();
    if (span)
      given.frames.back() =
          place_camera(pose_at(*span, recorded), body_from_camera, recorded.has_uncertainty);
    else
      ++given.without_pose;
  }
  // where the reader of the file knew no times
  if (recorded.key != PoseKey::stamp || (recorded.format == "truth" && !has_clock(sequence)))
    warn_of_jumps(recorded.source.string(), sequence, given);
  return given;
}

}  // namespace

GivenPoses read_given_poses(const Sequence& sequence, const GivenPosesOptions& options) {
  require(!sequence.frames.empty(), "the sequence has frames");
  check_options(options);
  try {
    return read_checked(sequence, options);
  } catch (const fs::filesystem_error& error) {
    throw InputError({error.path1().string(), 0, "a readable file or folder", error.code().message(),
                      "Check the path and its permissions."});
  }
}

std::vector<std::optional<WorldFromCamera>> poses_of_frames(const Sequence& sequence,
                                                            const GivenPosesOptions& options) {
  std::vector<std::optional<WorldFromCamera>> poses;
  for (const auto& given : read_given_poses(sequence, options).frames)
    poses.push_back(given ? std::optional(given->world_from_camera) : std::nullopt);
  return poses;
}

std::optional<fs::path> oxts_in(const fs::path& sequence_folder) {
  const fs::path oxts = sequence_folder / "oxts";
  return is_oxts(oxts) ? std::optional(oxts) : std::nullopt;
}

}  // namespace cairn
