// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/image_pair.h"

#include <array>

#include "cairn/core/error.h"
#include "cairn/sequence/camera_numbers.h"
#include "cairn/sequence/formats.h"

namespace cairn {

Sequence open_image_pair(const std::filesystem::path& color, const std::filesystem::path& depth,
                         const std::string& camera) {
  Sequence sequence;
  sequence.folder = color.parent_path();
  sequence.format = "two images";
  sequence.has_times = false;
  sequence.calibration = read_named_calibration(camera);
  sequence.calibration_source = camera;
  FrameFiles files;
  files.color = color;
  files.depth = depth;
  sequence.frames = {files};
  sequence.listed = sequence.report.color_images = sequence.report.depth_images = sequence.report.associated =
      1;
  if (!sequence.calibration.depth)
    throw InputError({"--camera", 0, "the scale of the depth image, units in a metre", "none",
                      "Give fx,fy,cx,cy,scale (scale 1000 where depth is in millimetres, 5000 for the TUM "
                      "benchmark), or 'depth: {scale: ...}' in a camera.yaml."});
  Camera& own = sequence.calibration.camera;
  if (own.width > 0) return sequence;
  const ImageSize size = size_of_images(std::array{color});
  own.width = size.width;
  own.height = size.height;
  return sequence;
}

}  // namespace cairn
