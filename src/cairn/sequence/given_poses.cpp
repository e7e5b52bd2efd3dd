// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/given_poses.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cairn/core/error.h"
#include "cairn/geometry/covariance.h"
#include "cairn/sequence/formats.h"
#include "cairn/sequence/geodetic.h"
#include "cairn/sequence/pose_jumps.h"
#include "cairn/sequence/pose_path.h"
#include "cairn/sequence/pose_times.h"
#include "cairn/sequence/recorded_poses.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;

void check_options(const GivenPosesOptions& options) {
  constexpr double kLargest = 9e9;  // seconds; the stamps' own range
  const auto check = [](bool holds, const char* name, const char* expected, double found) {
    if (!holds) throw InputError({name, 0, expected, fmt::format("{}", found), "Correct the value."});
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

/// Holds poses that were read, in one world of metres, and which of them each frame lies between.
struct PlacedPoses {
  RecordedPoses recorded;
  PoseSpans spans;
  GivenPoses given;  ///< all but the frames
};

PlacedPoses place_poses(const Sequence& sequence, const GivenPosesOptions& options) {
  PlacedPoses placed;
  auto& [recorded, spans, given] = placed;
  recorded =
      options.path.empty() ? own_poses(sequence) : read_recorded_poses(options.path, !has_clock(sequence));
  given.subject_from_camera = subject_from_camera(sequence, recorded);
  expect_one_for_each_frame(sequence, recorded);
  if (recorded.key == PoseKey::stamp)
    given.time_offset_s = 1e-9 * static_cast<double>(shift_stamps(sequence, options, recorded));
  spans = spans_of_frames(sequence, recorded, options, given.time_offset_s);
  given.source = recorded.source;
  given.format = recorded.format;
  given.warnings = recorded.warnings;
  warn_of_open_subject(sequence, recorded, given);
  if (recorded.geodetic) {
    given.origin = options.origin.value_or(origin_at(recorded.poses[first_used(spans)].place));
    move_to_origin(*given.origin, recorded);
  }
  return placed;
}

/// Returns whether poses belong to frames by their numbers or order, so that they have no times of their own.
bool are_by_frame(const Sequence& sequence, const RecordedPoses& recorded) {
  return recorded.key != PoseKey::stamp || (recorded.format == "truth" && !has_clock(sequence));
}

GivenPoses read_checked(const Sequence& sequence, const GivenPosesOptions& options) {
  PlacedPoses placed = place_poses(sequence, options);
  const RecordedPoses& recorded = placed.recorded;
  GivenPoses given = std::move(placed.given);
  for (const auto& span : placed.spans) {
    given.frames.emplace_back();
    if (span)
      given.frames.back() =
          place_camera(pose_at(*span, recorded), given.subject_from_camera, recorded.has_uncertainty);
    else
      ++given.without_pose;
  }
  if (are_by_frame(sequence, recorded)) warn_of_jumps(recorded.source.string(), sequence, given);
  return given;
}

SubjectPose subject_pose(std::int64_t stamp_ns, const RecordedPose& pose) {
  return {stamp_ns, {pose.rotation, pose.place}};
}

/// Returns whether the poses are the truth of the camera that was made from that of a body.
bool is_truth_of_body(const Sequence& sequence, const RecordedPoses& recorded) {
  return recorded.format == "truth" && sequence.format == "EuRoC" && sequence.calibration.body_from_camera;
}

GivenPath read_checked_path(const Sequence& sequence, const GivenPosesOptions& options) {
  const PlacedPoses placed = place_poses(sequence, options);
  const RecordedPoses& recorded = placed.recorded;
  std::vector<SubjectPose> poses;
  if (recorded.key == PoseKey::stamp) {
    for (const RecordedPose& pose : recorded.poses) poses.push_back(subject_pose(pose.key, pose));
  } else {
    for (std::size_t i = 0; i < placed.spans.size(); ++i)
      if (placed.spans[i])
        poses.push_back(subject_pose(sequence.frames[i].stamp_ns, pose_at(*placed.spans[i], recorded)));
  }
  GivenPath given;
  given.subject_from_camera = placed.given.subject_from_camera;
  given.is_of_body =
      recorded.subject != PoseSubject::camera &&
      (recorded.subject != PoseSubject::not_stated || sequence.calibration.body_from_camera.has_value());
  if (is_truth_of_body(sequence, recorded)) {
    given.is_of_body = true;
    given.subject_from_camera =
        body_from_loaded_camera(sequence.calibration, *sequence.calibration.body_from_camera);
    for (SubjectPose& pose : poses)
      pose.world_from_subject = pose.world_from_subject * given.subject_from_camera.inverse();
  }
  given.path = PosePath(std::move(poses), options.max_gap_s);
  given.is_by_frame = are_by_frame(sequence, recorded);
  given.time_offset_s = placed.given.time_offset_s;
  given.source = recorded.source;
  given.format = recorded.format;
  given.warnings = placed.given.warnings;
  return given;
}

/// Returns what `read` gives. Throws InputError also for what the file system does not let us read.
template <class Read>
auto with_file_errors(Read read) {
  try {
    return read();
  } catch (const fs::filesystem_error& error) {
    throw InputError({error.path1().string(), 0, "a readable file or folder", error.code().message(),
                      "Check the path and its permissions."});
  }
}

}  // namespace

GivenPoses read_given_poses(const Sequence& sequence, const GivenPosesOptions& options) {
  require(!sequence.frames.empty(), "the sequence has frames");
  check_options(options);
  return with_file_errors([&] { return read_checked(sequence, options); });
}

GivenPath read_given_path(const Sequence& sequence, const GivenPosesOptions& options) {
  require(!sequence.frames.empty(), "the sequence has frames");
  check_options(options);
  return with_file_errors([&] { return read_checked_path(sequence, options); });
}

std::vector<std::optional<WorldFromCamera>> camera_poses(const GivenPoses& given) {
  std::vector<std::optional<WorldFromCamera>> poses;
  for (const auto& pose : given.frames)
    poses.push_back(pose ? std::optional(pose->world_from_camera) : std::nullopt);
  return poses;
}

std::vector<std::optional<WorldFromCamera>> poses_of_frames(const Sequence& sequence,
                                                            const GivenPosesOptions& options) {
  return camera_poses(read_given_poses(sequence, options));
}

std::optional<fs::path> oxts_in(const fs::path& sequence_folder) {
  const fs::path oxts = sequence_folder / "oxts";
  return is_oxts(oxts) ? std::optional(oxts) : std::nullopt;
}

}  // namespace cairn
