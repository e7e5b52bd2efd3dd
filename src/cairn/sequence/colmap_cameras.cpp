// SPDX-License-Identifier: Apache-2.0
// COLMAP's cameras.txt: `CAMERA_ID MODEL WIDTH HEIGHT PARAMS[]` a line. Its first pixel has its centre at
// (0.5, 0.5).
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "cairn/core/error.h"
#include "cairn/core/text.h"
#include "cairn/sequence/calibration_formats.h"

namespace cairn {
namespace {

constexpr double kPixelCentre = 0.5;

/// Describes the parameters of one of COLMAP's models: focal lengths (one or two), principal point, then the
/// distortion.
struct ColmapModel {
  std::string_view name;
  std::size_t focals = 1, distortion = 0;
  std::string_view kind;  ///< name for set_distortion
};

/// Brown's with one or two radial coefficients, and the fisheyes with the first of four, lack the others.
constexpr std::array<ColmapModel, 11> kModels{{{"SIMPLE_PINHOLE", 1, 0, "none"},
                                               {"PINHOLE", 2, 0, "none"},
                                               {"SIMPLE_RADIAL", 1, 1, "opencv"},
                                               {"RADIAL", 1, 2, "opencv"},
                                               {"OPENCV", 2, 4, "opencv"},
                                               {"FULL_OPENCV", 2, 8, "opencv"},
                                               {"OPENCV_FISHEYE", 2, 4, "fisheye"},
                                               {"SIMPLE_RADIAL_FISHEYE", 1, 1, "fisheye"},
                                               {"RADIAL_FISHEYE", 1, 2, "fisheye"},
                                               {"FOV", 2, 1, "FOV"},
                                               {"THIN_PRISM_FISHEYE", 2, 8, "THIN_PRISM_FISHEYE"}}};

const ColmapModel* find_model(std::string_view name) {
  const auto* const found = std::find_if(kModels.begin(), kModels.end(),
                                         [&](const ColmapModel& model) { return model.name == name; });
  return found == kModels.end() ? nullptr : found;
}

/// The text of a camera without its id.
bool are_alike(const TextLine& a, const TextLine& b) {
  return std::equal(a.fields.begin() + 1, a.fields.end(), b.fields.begin() + 1, b.fields.end());
}

Camera parse_camera(const TextFile& file, const TextLine& line) {
  const ColmapModel* const model = find_model(line.fields[1]);
  if (!model)
    file.fail(line, "a camera model of COLMAP such as PINHOLE or OPENCV", fmt::format("'{}'", line.fields[1]),
              "Undistort the images (colmap image_undistorter) and take the PINHOLE camera that it writes.");
  const std::size_t parameters = model->focals + 2 + model->distortion;
  file.expect_fields(line, 4 + parameters,
                     fmt::format("id model width height and {} of {}", parameters, model->name));
  const SourceLocation place{file.path().string(), line.number};
  const auto parameter = [&](std::size_t i) { return file.number(line, 4 + i, "a parameter"); };
  Camera camera;
  set_image_size(file.number(line, 2, "the width"), file.number(line, 3, "the height"), place, camera);
  camera.fx = parameter(0);
  camera.fy = parameter(model->focals - 1);
  camera.cx = parameter(model->focals) - kPixelCentre;
  camera.cy = parameter(model->focals + 1) - kPixelCentre;
  check_intrinsics(place, camera);
  std::vector<double> distortion;
  for (std::size_t i = 0; i < model->distortion; ++i) distortion.push_back(parameter(model->focals + 2 + i));
  if (!distortion.empty()) distortion.resize(std::max<std::size_t>(4, distortion.size()));
  set_distortion(model->kind, distortion, place, camera);
  return camera;
}

}  // namespace

bool is_colmap_cameras(const std::filesystem::path& file) {
  const TextFile text(file);
  if (text.lines().empty()) return false;
  const auto& fields = text.lines().front().fields;
  std::int64_t id = 0;
  return fields.size() >= 4 && parse_integer(fields[0], id) &&
         fields[1].find_first_of("0123456789.") == std::string_view::npos &&
         std::all_of(fields[1].begin(), fields[1].end(),
                     [](char c) { return (c >= 'A' && c <= 'Z') || c == '_'; });
}

Calibration read_colmap_cameras(const std::filesystem::path& file) {
  const TextFile text(file);
  const auto& lines = text.lines();
  for (const TextLine& line : lines) {
    if (are_alike(line, lines.front())) continue;
    text.fail(line, "one camera, or several that are alike",
              fmt::format("another one than in line {}", lines.front().number),
              "Keep the line of the camera of these images in a file of its own.");
  }
  Calibration calibration;
  calibration.camera = parse_camera(text, lines.front());
  return calibration;
}

}  // namespace cairn
