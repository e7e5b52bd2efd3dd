// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/sequence.h"

#include <fmt/format.h>

#include <algorithm>

#include "cairn/core/error.h"
#include "cairn/sequence/calibration_choice.h"
#include "cairn/sequence/camera_numbers.h"
#include "cairn/sequence/formats.h"
#include "cairn/sequence/image_folders.h"
#include "cairn/sequence/recording_file.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;

/// Describes a folder without a known layout.
std::string describe_found(const fs::path& folder) {
  if (fs::is_empty(folder)) return "an empty folder";
  if (const auto recording = recording_in(folder)) return *recording;
  const std::string nearest = describe_nearest_layout(folder);
  return nearest.empty() ? "none of these" : nearest;
}

[[noreturn]] void fail_unknown_format(const fs::path& folder) {
  const bool has_rgb = fs::exists(folder / "rgb.txt"), has_depth = fs::exists(folder / "depth.txt");
  if (has_rgb || has_depth) {
    throw InputError({(folder / (has_rgb ? "depth.txt" : "rgb.txt")).string(), 0,
                      "the list of images in TUM layout, lines `stamp path`", "no such file",
                      "Both rgb.txt and depth.txt are needed, or associations.txt."});
  }
  throw InputError(
      {folder.string(), 0,
       "a sequence: TUM (rgb.txt, depth.txt), 7-Scenes (frame-000000.color.*), KITTI (image_0, "
       "image_1, calib.txt, times.txt), EuRoC (cam0, cam1, or mav0 with both), or two series of "
       "images (color/ and depth/, left/ and right/, left_* and right_*)",
       describe_found(folder),
       "Name the folder that holds these files, or the images by --color and --depth or by --left "
       "and --right."});
}

void list_frames(const fs::path& folder, const SequenceOptions& options, Sequence& sequence) {
  const bool are_named = !options.rgb_dir.empty() || !options.depth_dir.empty() || !options.left.empty() ||
                         !options.right.empty() || !options.color.empty() || !options.depth.empty();
  if (are_named) return list_image_pairs(folder, options, sequence);
  if (is_tum(folder)) return list_tum(folder, options, sequence);
  if (is_seven_scenes(folder)) return list_seven_scenes(folder, sequence);
  if (is_kitti(folder)) return list_kitti(folder, sequence);
  if (is_euroc(folder)) return list_euroc(folder, options, sequence);
  if (is_image_pairs(folder, options)) return list_image_pairs(folder, options, sequence);
  fail_unknown_format(folder);
}

/// What the numbers of --camera do not state, as the baseline of a pair, stays; its distortion does not.
CameraParameters camera_parameters(const SequenceOptions& options, Sequence& sequence) {
  CameraParameters given = options.camera_parameters;
  if (!gives_numbers(options.camera)) return given;
  const auto numbers = parse_camera_numbers(options.camera);
  if (!sequence.calibration.raw_stereo)
    sequence.calibration.camera = sequence.calibration.camera.undistorted();
  for (const auto field : {&CameraParameters::fx, &CameraParameters::fy, &CameraParameters::cx,
                           &CameraParameters::cy, &CameraParameters::scale})
    if (!(given.*field)) given.*field = (*numbers).*field;
  return given;
}

/// Parameters alone make a calibration, too: without distortion, of the images' size.
void apply_parameters(const CameraParameters& given, Sequence& sequence) {
  Calibration& calibration = sequence.calibration;
  Camera& camera = calibration.camera;
  if (calibration.raw_stereo && (given.fx || given.fy || given.cx || given.cy)) {
    throw InputError({"camera.fx, camera.fy, camera.cx, camera.cy", 0,
                      "none of them for a raw stereo pair, whose images are rectified", "one",
                      "Give a camera.yaml with both cameras instead (--camera)."});
  }
  if (camera.width == 0 && given.fx && given.fy && given.cx && given.cy && !sequence.frames.empty()) {
    std::vector<std::filesystem::path> images;
    for (const FrameFiles& files : sequence.frames) images.push_back(files.color);
    const ImageSize size = size_of_images(images);
    camera.width = size.width;
    camera.height = size.height;
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
      "benchmark --camera tum-fr1, tum-fr2 or tum-fr3.";
  if (sequence.calibration.camera.width == 0) {
    throw InputError({folder.string(), 0, "a calibration", "none", remedy});
  }
  if (sequence.calibration.raw_stereo && sequence.frames[0].right.empty()) {
    throw InputError({sequence.calibration_source, 0,
                      fmt::format("one camera, as a sequence of format {} has", sequence.format), "two",
                      "Delete 'right'."});
  }
  const bool has_depth = !sequence.frames.empty() && !sequence.frames[0].depth.empty();
  if (has_depth && !sequence.calibration.depth) {
    throw InputError(
        {sequence.calibration_source, 0,
         "'depth: {scale: ...}', units per metre, as the sequence has depth images", "none",
         "Add it (1000 where depth is in millimetres, 5000 for the TUM benchmark), of another program's "
         "calibration in a camera.yaml with 'depth' alone, or a fifth number to --camera fx,fy,cx,cy."});
  }
}

/// Frames of lists have no numbers in their names: the first one is 1.
bool is_listed(const std::vector<std::int64_t>& numbers, const Sequence& sequence, std::int64_t position) {
  const bool by_list = sequence.format == "TUM" || sequence.format == "EuRoC";
  const std::int64_t number =
      by_list ? position + 1 : sequence.frames[static_cast<std::size_t>(position)].number;
  return std::binary_search(numbers.begin(), numbers.end(), number);
}

void select_frames(const SequenceOptions& options, Sequence& sequence) {
  const auto count = static_cast<std::int64_t>(sequence.frames.size());
  std::vector<FrameFiles> kept;
  for (std::int64_t i = 0; i < count; ++i) {
    const FrameFiles& files = sequence.frames[static_cast<std::size_t>(i)];
    if (options.frames && !contains(*options.frames, i, count)) continue;
    if (options.frame_numbers && !is_listed(*options.frame_numbers, sequence, i)) continue;
    if (options.without && contains(*options.without, i, count)) continue;
    if (options.start_index && files.number < *options.start_index) continue;
    if (options.end_index && files.number >= *options.end_index) continue;
    kept.push_back(files);
    kept.back().position = i;
  }
  if (kept.empty()) {
    throw InputError({sequence.folder.string(), 0, "at least one frame",
                      fmt::format("0 of {} frames after selection", count),
                      count == 0 ? "Check that colour and depth images are there."
                                 : "Widen --frames, --without, start_index or end_index."});
  }
  sequence.listed = count;
  sequence.first_stamp_ns = sequence.frames.front().stamp_ns;
  sequence.frames = std::move(kept);
}

/// Poses of the depth camera, or of the left one before rectification, become poses of the camera that the
/// calibration has.
void move_truth_to_camera(Sequence& sequence) {
  const Calibration& calibration = sequence.calibration;
  if (!sequence.truth) return;
  const bool of_depth = calibration.poses_are == PosesAre::depth && calibration.depth;
  if (!of_depth && !calibration.raw_stereo) return;
  const Rigid3 given_from_camera = of_depth ? calibration.depth->camera_from_depth.inverse()
                                            : body_from_loaded_camera(calibration, Rigid3{});
  for (StampedPose& pose : *sequence.truth)
    pose.world_from_camera = WorldFromCamera(pose.world_from_camera * given_from_camera);
}

Sequence open_checked(const fs::path& folder, const SequenceOptions& options) {
  refuse_recording(folder);
  if (!fs::is_directory(folder)) {
    throw InputError({folder.string(), 0, "a folder with a sequence",
                      fs::exists(folder) ? "a file" : "nothing of that name", "Check the path."});
  }
  Sequence sequence;
  sequence.folder = folder;
  const ChosenCalibration chosen = choose_calibration(folder, options);
  chosen.apply(sequence);  // a reader asks for the rate, and where the camera sits on a body
  list_frames(folder, options, sequence);
  chosen.apply(sequence);  // goes before what the format carries
  select_frames(options, sequence);
  apply_parameters(camera_parameters(options, sequence), sequence);
  if (gives_numbers(options.camera)) sequence.calibration_source = "--camera";
  check_calibration(folder, sequence);
  move_truth_to_camera(sequence);
  return sequence;
}

}  // namespace

Sequence open_sequence(const fs::path& folder, const SequenceOptions& options) {
  check_ranges(options);
  try {
    return open_checked(folder, options);
  } catch (const fs::filesystem_error& error) {
    throw InputError({error.path1().string(), 0, "a readable file or folder", error.code().message(),
                      "Check the path and its permissions."});
  }
}

}  // namespace cairn
