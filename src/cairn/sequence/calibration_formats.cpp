// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/calibration_formats.h"

#include <fmt/format.h>

#include <array>

#include "cairn/core/error.h"
#include "cairn/core/file.h"
#include "cairn/core/text.h"
#include "cairn/sequence/formats.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail_xml(const fs::path& file) {
  throw InputError({file.string(), 1, "a calibration as YAML, JSON or COLMAP's text", "XML",
                    "Write it as YAML: OpenCV's FileStorage does if the name ends in .yaml."});
}

[[noreturn]] void fail_binary(const fs::path& file) {
  throw InputError({file.string(), 0, "a text file", "binary data by its name",
                    "Of a model of COLMAP write text: colmap model_converter --output_type TXT."});
}

/// Reads the depth's units a metre: above 1 as Open3D states them, below 1 as RealSense does, metres a unit.
std::optional<DepthCalibration> depth_of(const YamlMapping& mapping) {
  if (!mapping.has("depth_scale")) return std::nullopt;
  const double scale = mapping.positive("depth_scale");
  DepthCalibration depth;
  depth.scale = scale < 1 ? 1 / scale : scale;
  return depth;
}

/// The camera stands at the top, or as Open3D's and RealSense's programs nest it.
std::optional<YamlMapping> mapping_with_camera(const YamlMapping& root) {
  if (states_camera(root)) return root;
  for (const char* key : {"intrinsic", "intrinsics", "color", "color_intrinsics", "rgb"}) {
    if (!root.is_mapping(key)) continue;
    if (auto found = mapping_with_camera(root.sub(key, {}))) return found;
  }
  return std::nullopt;
}

std::optional<Calibration> read_mapping(const YamlMapping& root) {
  if (root.has("camera")) return std::nullopt;  // cairn's own
  if (root.is_mapping("cam0")) return read_camchain(root);
  const auto camera = mapping_with_camera(root);
  if (!camera) return std::nullopt;
  Calibration calibration;
  calibration.camera = read_stated_camera(*camera);
  calibration.depth = depth_of(root);
  return calibration;
}

}  // namespace

std::optional<Calibration> read_foreign_calibration(const fs::path& file) {
  const std::string text = read_file(file);
  if (text.starts_with("<?xml") || text.starts_with("<opencv_storage")) fail_xml(file);
  if (file.extension() == ".bin") fail_binary(file);
  expect_text(file, text);
  if (is_colmap_cameras(file)) return read_colmap_cameras(file);
  const YAML::Node root = load_yaml(file);
  if (!root.IsMap()) return std::nullopt;
  return read_mapping(YamlMapping(file.string(), "calibration", root, {}));
}

std::optional<fs::path> find_foreign_calibration(const fs::path& folder) {
  constexpr std::array<std::string_view, 11> kNames{
      "camchain.yaml",   "camera_info.yaml", "camera_info.yml",       "ost.yaml",
      "intrinsics.json", "intrinsic.json",   "camera_intrinsic.json", "camera_intrinsics.json",
      "camera.json",     "cameras.txt",      "sparse/0/cameras.txt"};
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) return std::nullopt;
  if (const fs::path left = folder / "left.yaml"; fs::is_regular_file(left, ignored) && right_beside(left))
    return left;
  for (const fs::path& file : files_in(folder)) {
    const std::string name = file.filename().string();
    if (name.find("camchain") != std::string::npos && file.extension() == ".yaml") return file;
  }
  for (const std::string_view name : kNames)
    if (fs::is_regular_file(folder / name, ignored)) return folder / name;
  return std::nullopt;
}

}  // namespace cairn
