// SPDX-License-Identifier: Apache-2.0
// A camera by its 3x3 matrix, as ROS (camera_calibration's YAML, and the message camera_info as `rostopic
// echo` and `ros2 topic echo` print it), OpenCV (FileStorage) and Open3D (by columns) write it, or by its
// numbers, as RealSense does.
#include <fmt/format.h>

#include <initializer_list>

#include "cairn/core/error.h"
#include "cairn/sequence/calibration_formats.h"

namespace cairn {
namespace {

using Names = std::initializer_list<const char*>;

constexpr Names kMatrix{"camera_matrix", "Camera_Matrix", "cameraMatrix", "K", "k"};
constexpr Names kDistortion{
    "distortion_coefficients", "Distortion_Coefficients", "distCoeffs", "dist_coeffs", "coeffs", "D", "d"};
constexpr Names kWidth{"image_width", "image_Width", "width"};
constexpr Names kHeight{"image_height", "image_Height", "height"};
constexpr const char* kByColumns = "intrinsic_matrix";  // Open3D

/// Returns the first of the names that the mapping has; else the first, for the message.
std::string key_of(const YamlMapping& mapping, Names names) {
  for (const char* name : names)
    if (mapping.has(name)) return name;
  return *names.begin();
}

SourceLocation place_of(const YamlMapping& mapping) {
  return {mapping.file(), mapping.line()};
}

/// Reads a list of numbers, bare or as the data of a matrix {rows, cols, data}.
std::vector<double> list_of(const YamlMapping& mapping, const std::string& key) {
  constexpr const char* kKind = "a list of numbers";
  if (mapping.is_mapping(key)) return list_of(mapping.sub(key, {}), "data");
  return mapping.get<std::vector<double>>(key, kKind);
}

std::vector<double> list_of(const YamlMapping& mapping, const std::string& key, std::size_t count,
                            const std::string& kind) {
  std::vector<double> values = list_of(mapping, key);
  mapping.check(values.size() == count, key, kind);
  return values;
}

void read_matrix(const YamlMapping& mapping, Camera& camera) {
  const bool by_columns = mapping.has(kByColumns);
  const std::string key = by_columns ? kByColumns : key_of(mapping, kMatrix);
  std::vector<double> k = list_of(mapping, key, 9, "9 numbers, a 3x3 matrix");
  if (by_columns) k = {k[0], k[3], k[6], k[1], k[4], k[7], k[2], k[5], k[8]};
  mapping.check(k[3] == 0 && k[6] == 0 && k[7] == 0 && k[8] == 1, key, "a matrix fx 0 cx, 0 fy cy, 0 0 1");
  mapping.check(k[1] == 0, key, "pixels without skew (second value 0)");
  camera.fx = k[0];
  camera.cx = k[2];
  camera.fy = k[4];
  camera.cy = k[5];
}

void read_numbers(const YamlMapping& mapping, Camera& camera) {
  camera.fx = mapping.number("fx");
  camera.fy = mapping.number("fy");
  camera.cx = mapping.number(key_of(mapping, {"ppx", "cx"}));
  camera.cy = mapping.number(key_of(mapping, {"ppy", "cy"}));
}

/// Takes the enumerator's name out of librealsense's "distortion.brown_conrady" and "Brown Conrady".
std::string plain_model(std::string name) {
  if (const std::size_t dot = name.rfind('.'); dot != std::string::npos) name.erase(0, dot + 1);
  for (char& c : name) c = c == ' ' ? '_' : c;
  return name;
}

std::string model_of(const YamlMapping& mapping) {
  for (const char* key : {"distortion_model", "model"})
    if (mapping.has(key)) return plain_model(mapping.get<std::string>(key, "a distortion model"));
  const bool is_fisheye = mapping.has("fisheye_model") && mapping.number("fisheye_model") != 0;
  return is_fisheye ? "fisheye" : "";
}

/// Returns the matrix of a ROS calibration by either name, rectification_matrix or R.
std::vector<double> ros_matrix(const YamlMapping& mapping, Names names, std::size_t count) {
  return list_of(mapping, key_of(mapping, names), count, fmt::format("{} numbers", count));
}

Rigid3 rectified_from_raw(const YamlMapping& mapping) {
  const auto r = ros_matrix(mapping, {"rectification_matrix", "R", "r"}, 9);
  const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> rotation(r.data());
  return transform_of(rotation, Eigen::Vector3d::Zero(), place_of(mapping));
}

/// Returns the right camera's distance from the left one, of the fourth column of its projection: -fx b.
double baseline_of(const YamlMapping& right) {
  const auto p = ros_matrix(right, {"projection_matrix", "P", "p"}, 12);
  if (p[0] > 0 && p[3] < 0) return -p[3] / p[0];
  throw InputError({right.file(), right.line(),
                    "the right camera of a pair: -fx times the baseline as fourth value of projection_matrix",
                    fmt::format("{:g}", p[3]),
                    p[3] > 0 ? "Exchange the files of the left and the right camera."
                             : "Calibrate the cameras as a pair."});
}

YamlMapping open_ros(const std::filesystem::path& file) {
  return {file.string(), "calibration", load_yaml(file), {}};
}

}  // namespace

bool states_camera(const YamlMapping& mapping) {
  for (const char* name : kMatrix)
    if (mapping.has(name)) return true;
  return mapping.has(kByColumns) || (mapping.has("fx") && mapping.has("fy"));
}

Camera read_stated_camera(const YamlMapping& mapping) {
  Camera camera;
  mapping.has("fx") ? read_numbers(mapping, camera) : read_matrix(mapping, camera);
  check_intrinsics(place_of(mapping), camera);
  set_image_size(mapping.number(key_of(mapping, kWidth)), mapping.number(key_of(mapping, kHeight)),
                 place_of(mapping), camera);
  const std::string key = key_of(mapping, kDistortion);
  const std::vector<double> distortion = mapping.has(key) ? list_of(mapping, key) : std::vector<double>{};
  set_distortion(model_of(mapping), distortion, place_of(mapping), camera);
  return camera;
}

std::optional<std::filesystem::path> right_beside(const std::filesystem::path& left) {
  std::string name = left.filename().string();
  const std::size_t at = name.rfind("left");
  if (at == std::string::npos) return std::nullopt;
  std::error_code ignored;
  const std::filesystem::path right = left.parent_path() / name.replace(at, 4, "right");
  return std::filesystem::is_regular_file(right, ignored) ? std::optional(right) : std::nullopt;
}

/// Both cameras turned by their rectifications look the same way, the right one at (baseline, 0, 0).
Calibration read_ros_pair(const std::filesystem::path& left, const std::filesystem::path& right) {
  const YamlMapping of_left = open_ros(left), of_right = open_ros(right);
  const Rigid3 rectified_from_right{rectified_from_raw(of_right).rotation, {baseline_of(of_right), 0, 0}};
  const LeftFromRight left_from_right(rectified_from_raw(of_left).inverse() * rectified_from_right);
  Calibration calibration;
  set_raw_stereo({read_stated_camera(of_left), read_stated_camera(of_right), left_from_right},
                 place_of(of_right), calibration);
  return calibration;
}

}  // namespace cairn
