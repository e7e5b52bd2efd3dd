// SPDX-License-Identifier: Apache-2.0
#include "localize_query.h"

#include <fmt/format.h>

#include <algorithm>

#include "cairn/core/error.h"
#include "cairn/sequence/formats.h"

namespace cairn::app {
namespace {

namespace fs = std::filesystem;

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

Calibration chosen_calibration(const std::string& camera, const MapInfo& map) {
  if (camera.empty()) return camera_of(map);
  if (const auto known = known_calibration(camera)) return *known;
  return read_calibration(camera);
}

/// Images that lie side by side in a folder which is no sequence.
std::vector<fs::path> images_in(const fs::path& folder) {
  std::vector<fs::path> images;
  for (const fs::path& file : files_in(folder))
    if (is_image_name(file)) images.push_back(file);
  return images;
}

Sequence sequence_of(const std::vector<fs::path>& images, const fs::path& folder,
                     const SequenceOptions& options, const MapInfo& map) {
  Sequence sequence;
  sequence.folder = folder;
  sequence.format = "images";
  sequence.calibration = chosen_calibration(options.camera, map);
  sequence.calibration_source = options.camera.empty() ? "the map" : options.camera;
  const auto count = static_cast<std::int64_t>(images.size());
  for (std::int64_t i = 0; i < count; ++i) {
    if (options.frames && !contains(*options.frames, i, count)) continue;
    if (options.without && contains(*options.without, i, count)) continue;
    sequence.frames.push_back(
        {stamp_of_number(i, sequence.calibration.rate_hz), i, images[static_cast<std::size_t>(i)], {}, {}});
  }
  if (sequence.frames.empty())
    throw InputError({folder.string(), 0, "at least one image", fmt::format("0 of {} after selection", count),
                      "Widen --frames or --without."});
  return sequence;
}

bool is_sequence(const fs::path& folder, const SequenceOptions& options) {
  return is_tum(folder) || is_seven_scenes(folder) || is_kitti(folder) || is_euroc(folder) ||
         is_numbered(folder, options);
}

}  // namespace

Sequence open_query(const std::string& path, const SequenceOptions& options, const MapInfo& map, bool mono) {
  std::error_code error;
  if (fs::is_regular_file(path, error)) return sequence_of({path}, path, options, map);
  if (fs::is_directory(path, error) && !is_sequence(path, options))
    if (const auto images = images_in(path); !images.empty()) return sequence_of(images, path, options, map);
  Sequence sequence = open_sequence(path, options);
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
  const Camera& camera = sequence.calibration.camera;
  return {rig_of(sequence.calibration, noise), camera.width, camera.height};
}

}  // namespace cairn::app
