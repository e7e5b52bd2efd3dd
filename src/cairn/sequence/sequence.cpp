// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/sequence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cairn/core/error.h"
#include "cairn/core/text.h"
#include "cairn/image/codec.h"
#include "cairn/sequence/association.h"
#include "cairn/sequence/formats.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;

/// The calibration in the order of who may say: parameter file, --camera, the folder. Nothing: the format's
/// own.
void choose_calibration(const fs::path& folder, const SequenceOptions& options, Sequence& sequence) {
  const auto take = [&](const Calibration& calibration, std::string source) {
    sequence.calibration = calibration;
    sequence.calibration_source = std::move(source);
  };
  if (!options.camera.empty()) {
    if (const auto known = known_calibration(options.camera)) return take(*known, options.camera);
    return take(read_calibration(options.camera), options.camera);
  }
  const fs::path own = folder / "camera.yaml";
  if (fs::exists(own)) take(read_calibration(own), own.string());
}

[[noreturn]] void fail_unknown_format(const fs::path& folder) {
  throw InputError({folder.string(), 0,
                    "a sequence: TUM (rgb.txt, depth.txt), 7-Scenes (frame-000000.color.*), KITTI (image_0, "
                    "image_1, calib.txt, times.txt) or numbered files",
                    fs::is_empty(folder) ? "an empty folder" : "none of these",
                    "Name the folder that holds these files, or rgb_dir and depth_dir in a parameter file."});
}

void list_frames(const fs::path& folder, const SequenceOptions& options, Sequence& sequence) {
  if (!options.rgb_dir.empty()) return list_numbered(folder, options, sequence);
  if (is_tum(folder)) return list_tum(folder, options, sequence);
  if (is_seven_scenes(folder)) return list_seven_scenes(folder, sequence);
  if (is_kitti(folder)) return list_kitti(folder, sequence);
  if (is_numbered(folder, options)) return list_numbered(folder, options, sequence);
  fail_unknown_format(folder);
}

void check_parameters(const CameraParameters& given) {
  const auto check = [](const std::optional<double>& value, const char* name) {
    if (!value || *value > 0) return;
    throw InputError({name, 0, "a number above 0", fmt::format("{}", *value), "Mend the value."});
  };
  check(given.fx, "camera.fx");
  check(given.fy, "camera.fy");
  check(given.scale, "camera.scale");
}

/// Parameters alone make a calibration, too: without distortion, of the first image's size.
void apply_parameters(const CameraParameters& given, Sequence& sequence) {
  check_parameters(given);
  Calibration& calibration = sequence.calibration;
  Camera& camera = calibration.camera;
  if (camera.width == 0 && given.fx && given.fy && given.cx && given.cy && !sequence.frames.empty()) {
    const GrayImage first = read_gray(sequence.frames.front().color);
    camera.width = first.width();
    camera.height = first.height();
    sequence.calibration_source = "the parameters";
  }
  camera.fx = given.fx.value_or(camera.fx);
  camera.fy = given.fy.value_or(camera.fy);
  camera.cx = given.cx.value_or(camera.cx);
  camera.cy = given.cy.value_or(camera.cy);
  if (!given.scale) return;
  if (!calibration.depth) calibration.depth.emplace();
  calibration.depth->scale = *given.scale;
}

void check_calibration(const fs::path& folder, const Sequence& sequence) {
  const std::string remedy =
      "Put a camera.yaml into the folder or give --camera FILE (README, \"Calibration\"); for the TUM "
      "benchmark --camera tum-fr1.";
  if (sequence.calibration.camera.width == 0) {
    throw InputError({folder.string(), 0, "a calibration", "none", remedy});
  }
  const bool has_depth = !sequence.frames.empty() && !sequence.frames[0].depth.empty();
  if (has_depth && !sequence.calibration.depth) {
    throw InputError({sequence.calibration_source, 0,
                      "'depth: {scale: ...}', units per metre, as the sequence has depth images", "none",
                      "Add it (1000 where depth is in millimetres, 5000 for the TUM benchmark)."});
  }
}

bool in_range(const FrameRange& range, std::int64_t position, std::int64_t count) {
  const auto absolute = [&](std::int64_t value) {
    return std::clamp<std::int64_t>(value < 0 ? value + count : value, 0, count);
  };
  const std::int64_t begin = absolute(range.begin.value_or(0));
  return position >= begin && position < absolute(range.end.value_or(count)) &&
         (position - begin) % range.step == 0;
}

void select_frames(const SequenceOptions& options, Sequence& sequence) {
  const auto count = static_cast<std::int64_t>(sequence.frames.size());
  std::vector<FrameFiles> kept;
  for (std::int64_t i = 0; i < count; ++i) {
    const FrameFiles& files = sequence.frames[static_cast<std::size_t>(i)];
    if (options.frames && !in_range(*options.frames, i, count)) continue;
    if (options.without && in_range(*options.without, i, count)) continue;
    if (options.start_index && files.number < *options.start_index) continue;
    if (options.end_index && files.number > *options.end_index) continue;
    kept.push_back(files);
  }
  if (kept.empty()) {
    throw InputError({sequence.folder.string(), 0, "at least one frame",
                      fmt::format("{} of {} frames after selection", kept.size(), count),
                      count == 0 ? "Check that colour and depth images are there."
                                 : "Widen --frames, --without, start_index or end_index."});
  }
  sequence.frames = std::move(kept);
}

/// Poses of the depth camera become poses of the colour camera.
void honour_poses_are(Sequence& sequence) {
  if (!sequence.truth || sequence.calibration.poses_are != PosesAre::depth || !sequence.calibration.depth)
    return;
  const Rigid3 depth_from_camera = sequence.calibration.depth->camera_from_depth.inverse();
  for (StampedPose& pose : *sequence.truth)
    pose.world_from_camera = pose.world_from_camera * depth_from_camera;
}

std::optional<std::int64_t> parse_bound(std::string_view text, const std::string& whole,
                                        const std::string& option) {
  if (text.empty()) return std::nullopt;
  std::int64_t value = 0;
  if (parse_integer(text, value)) return value;
  throw InputError({option, 0, "A:B or A:B:S with whole numbers, as a Python slice",
                    fmt::format("'{}'", whole), "For example 0:400 or ::2."});
}

std::vector<std::optional<Rigid3>> poses_by_time(const Sequence& sequence, const Trajectory& trajectory,
                                                 double max_gap_s) {
  std::vector<std::int64_t> frame_stamps, pose_stamps;
  for (const FrameFiles& files : sequence.frames) frame_stamps.push_back(files.stamp_ns);
  for (const StampedPose& pose : trajectory) pose_stamps.push_back(pose.stamp_ns);
  std::vector<std::optional<Rigid3>> poses(sequence.frames.size());
  for (const auto& [frame, pose] :
       associate_stamps(frame_stamps, pose_stamps, std::llround(max_gap_s * 1e9))) {
    poses[frame] = trajectory[pose].world_from_camera;
  }
  return poses;
}

void expect_some(const std::vector<std::optional<Rigid3>>& poses, const std::string& file, double max_gap_s) {
  if (std::any_of(poses.begin(), poses.end(), [](const auto& pose) { return pose.has_value(); })) return;
  throw InputError({file, 0, fmt::format("poses within {} s of the frames", max_gap_s), "none",
                    "Check that the poses belong to this sequence and share its clock."});
}

}  // namespace

FrameRange parse_frame_range(const std::string& text, const std::string& option) {
  FrameRange range;
  const std::string_view all = text;
  const std::size_t first = all.find(':');
  const std::size_t second = first == std::string::npos ? first : all.find(':', first + 1);
  const bool lone = first == std::string::npos;
  range.begin = parse_bound(lone ? "-" : all.substr(0, first), text, option);
  range.end = parse_bound(all.substr(first + 1, second == std::string::npos ? second : second - first - 1),
                          text, option);
  if (second != std::string::npos) range.step = parse_bound(all.substr(second + 1), text, option).value_or(1);
  if (range.step < 1)
    throw InputError({option, 0, "a step of at least 1", fmt::format("'{}'", text), "For example ::2."});
  return range;
}

Sequence open_sequence(const fs::path& folder, const SequenceOptions& options) {
  if (!fs::is_directory(folder)) {
    throw InputError({folder.string(), 0, "a folder with a sequence",
                      fs::exists(folder) ? "a file" : "nothing of that name", "Check the path."});
  }
  Sequence sequence;
  sequence.folder = folder;
  choose_calibration(folder, options, sequence);
  const Sequence chosen = sequence;
  list_frames(folder, options, sequence);
  if (!chosen.calibration_source.empty()) {  // goes before what the format carries
    sequence.calibration = chosen.calibration;
    sequence.calibration_source = chosen.calibration_source;
  }
  select_frames(options, sequence);
  apply_parameters(options.camera_parameters, sequence);
  check_calibration(folder, sequence);
  honour_poses_are(sequence);
  return sequence;
}

std::vector<std::optional<Rigid3>> poses_of_frames(const Sequence& sequence, const fs::path& path,
                                                   double max_gap_s) {
  if (path.empty()) {
    if (!sequence.truth) {
      throw InputError({sequence.folder.string(), 0, "poses", "a sequence that carries none",
                        "Give --poses FILE (TUM format)."});
    }
    auto poses = poses_by_time(sequence, *sequence.truth, max_gap_s);
    expect_some(poses, sequence.folder.string(), max_gap_s);
    return poses;
  }
  Trajectory trajectory = read_tum_trajectory(path);
  if (sequence.format != "TUM" && has_frame_numbers(path)) {
    for (StampedPose& pose : trajectory)
      pose.stamp_ns = stamp_of_number(pose.stamp_ns / 1'000'000'000, sequence.calibration.rate_hz);
  }
  auto poses = poses_by_time(sequence, trajectory, max_gap_s);
  expect_some(poses, path.string(), max_gap_s);
  return poses;
}

}  // namespace cairn
