// SPDX-License-Identifier: Apache-2.0
#include "localize_query.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "cairn/core/error.h"
#include "cairn/image/codec.h"
#include "cairn/sequence/calibration_choice.h"
#include "cairn/sequence/formats.h"

namespace cairn::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFromMap = "the map";

Calibration camera_of(const MapInfo& map) {
  Calibration calibration;
  calibration.camera.width = map.width;
  calibration.camera.height = map.height;
  calibration.camera.fx = map.rig.fx;
  calibration.camera.fy = map.rig.fy;
  calibration.camera.cx = map.rig.cx;
  calibration.camera.cy = map.rig.cy;
  return calibration;
}

/// The calibration in the order of who may say: --camera, one beside the images, the map. Tells whether a
/// rate is stated for the images: beside them, as a rate that comes with --camera is the camera's.
bool take_calibration(const fs::path& folder, const SequenceOptions& options, const MapInfo& map,
                      Sequence& sequence) {
  const ChosenCalibration chosen = choose_calibration(folder, options);
  if (!chosen.whole && !(map.width > 0 && map.height > 0)) {
    throw InputError({"--camera", 0,
                      "the calibration of the images, as the map does not say the size of its own", "none",
                      "Give --camera FILE."});
  }
  sequence.calibration = camera_of(map);
  sequence.calibration_source = kFromMap;
  chosen.apply(sequence);
  return options.camera.empty() ? sequence.calibration.rate_hz.has_value()
                                : chosen.addition && chosen.addition->rate_hz;
}

std::optional<GrayImage> read_if_possible(const fs::path& path) {
  try {
    return read_gray(path);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

/// Images without a calibration need the map's size. One that cannot be read is left to whoever reads it
/// next.
void expect_map_size(const fs::path& path, const MapInfo& map) {
  const std::optional<GrayImage> image = read_if_possible(path);
  if (!image || (image->width() == map.width && image->height() == map.height)) return;
  throw InputError(
      {path.string(), 0,
       fmt::format("an image of {}x{} pixels, as the map's camera has, or a calibration", map.width,
                   map.height),
       fmt::format("{}x{} and no calibration", image->width(), image->height()),
       "Give the calibration of the camera of these images by --camera FILE; they are scaled to the map's."});
}

/// Images that lie side by side in a folder which is no sequence.
std::vector<fs::path> images_in(const fs::path& folder) {
  std::vector<fs::path> images;
  for (const fs::path& file : files_in(folder))
    if (is_image_name(file)) images.push_back(file);
  return images;
}

/// Only images of a video have times, by the rate that the calibration states. The stamps of others are their
/// positions in the folder as whole seconds.
void list_images(const std::vector<fs::path>& images, const SequenceOptions& options, bool is_video,
                 Sequence& sequence) {
  sequence.has_times = is_video;
  const double rate_hz = is_video ? sequence.calibration.stamp_rate_hz() : 1;
  const auto count = static_cast<std::int64_t>(images.size());
  for (std::int64_t i = 0; i < count; ++i) {
    if (options.frames && !contains(*options.frames, i, count)) continue;
    if (options.without && contains(*options.without, i, count)) continue;
    sequence.frames.push_back(
        {stamp_of_number(i, rate_hz), i, images[static_cast<std::size_t>(i)], {}, {}, i});
  }
  sequence.listed = count;
  if (sequence.frames.empty())
    throw InputError({sequence.folder.string(), 0, "at least one image",
                      fmt::format("0 of {} after selection", count), "Widen --frames or --without."});
}

Sequence sequence_of(const std::vector<fs::path>& images, const fs::path& folder,
                     const SequenceOptions& options, const MapInfo& map) {
  Sequence sequence;
  sequence.folder = folder;
  sequence.format = "images";
  const bool is_video = take_calibration(folder, options, map, sequence);
  list_images(images, options, is_video, sequence);
  if (sequence.calibration_source == kFromMap) expect_map_size(sequence.frames.front().color, map);
  return sequence;
}

/// Frames of 7-Scenes that were picked without their depth images are images like others.
bool has_depth_images(const fs::path& folder) {
  const std::vector<fs::path> files = files_in(folder);
  return std::any_of(files.begin(), files.end(), [](const fs::path& file) {
    return file.filename().string().find(".depth.") != std::string::npos;
  });
}

bool is_sequence(const fs::path& folder, const SequenceOptions& options) {
  return is_tum(folder) || (is_seven_scenes(folder) && has_depth_images(folder)) || is_kitti(folder) ||
         is_euroc(folder) || is_image_pairs(folder, options);
}

}  // namespace

Sequence open_query(const std::string& path, const SequenceOptions& options, const MapInfo& map, bool mono) {
  std::error_code error;
  if (fs::is_regular_file(path, error)) return sequence_of({path}, path, options, map);
  if (fs::is_directory(path, error) && !is_sequence(path, options))
    if (const auto images = images_in(path); !images.empty()) return sequence_of(images, path, options, map);
  Sequence sequence = open_sequence(path, options);
  // A pair that is calibrated as that of the map shows the same errors. If the map corrects none, what is
  // stated stays.
  if (is_stereo(sequence) && map.right_correction && are_same(rig_of(sequence.calibration, {}), map.rig))
    sequence.calibration.right_correction = map.right_correction;
  if (!mono) return sequence;
  for (FrameFiles& files : sequence.frames) {
    files.depth.clear();
    files.right.clear();
  }
  return sequence;
}

QueryCamera query_camera(const Sequence& sequence, const MapInfo& map) {
  DepthNoise noise;
  noise.baseline = map.rig.baseline;
  Calibration calibration = sequence.calibration;
  calibration.camera = camera_for_queries(map, calibration.camera);
  return {rig_of(calibration, noise), calibration.camera.width, calibration.camera.height};
}

}  // namespace cairn::app
