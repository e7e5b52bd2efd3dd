// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/asl_sensor.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "cairn/sequence/yaml_mapping.h"

namespace cairn {
namespace {

YamlMapping open_sensor(const std::filesystem::path& path) {
  return {path.string(), "sensor", load_yaml(path), {}};
}

/// Kalibr's names are understood, too.
CameraModel parse_model(const YamlMapping& sensor) {
  sensor.check(sensor.get<std::string>("camera_model", "a camera model") == "pinhole", "camera_model",
               "pinhole");
  const auto name = sensor.get<std::string>("distortion_model", "a distortion model");
  if (name == "radial-tangential" || name == "radtan") return CameraModel::radtan;
  if (name == "equidistant" || name == "equi") return CameraModel::kb4;
  sensor.check(name == "none", "distortion_model", "radial-tangential, equidistant or none");
  return CameraModel::pinhole;
}

void parse_distortion(const YamlMapping& sensor, Camera& camera) {
  if (camera.model == CameraModel::pinhole) return;
  constexpr const char* kKey = "distortion_coefficients";
  constexpr const char* kKind = "a list of numbers: k1 k2 p1 p2 [k3], or k1 k2 k3 k4 of an equidistant lens";
  const std::size_t given = sensor.get<std::vector<double>>(kKey, kKind).size();
  const bool has_k3 = camera.model == CameraModel::radtan && given == 5;
  const std::vector<double> values = sensor.numbers(kKey, has_k3 ? 5 : 4, kKind);
  std::copy(values.begin(), values.end(), camera.distortion.begin());
}

}  // namespace

Camera read_asl_camera(const std::filesystem::path& sensor_yaml) {
  const YamlMapping sensor = open_sensor(sensor_yaml);
  Camera camera;
  camera.model = parse_model(sensor);
  constexpr double kMaxSide = 32768;
  const auto size = sensor.numbers("resolution", 2, "two whole numbers: width and height in pixels");
  for (const double side : size) {
    sensor.check(side >= 1 && side <= kMaxSide && side == std::floor(side), "resolution",
                 "whole numbers of pixels from 1 to 32768");
  }
  camera.width = static_cast<int>(size[0]);
  camera.height = static_cast<int>(size[1]);
  const auto intrinsics = sensor.numbers("intrinsics", 4, "four numbers: fu fv cu cv in pixels");
  sensor.check(intrinsics[0] > 0 && intrinsics[1] > 0, "intrinsics", "focal lengths above 0");
  camera.fx = intrinsics[0];
  camera.fy = intrinsics[1];
  camera.cx = intrinsics[2];
  camera.cy = intrinsics[3];
  parse_distortion(sensor, camera);
  return camera;
}

Rigid3 read_body_from_sensor(const std::filesystem::path& sensor_yaml) {
  const YamlMapping sensor = open_sensor(sensor_yaml);
  sensor.expect("T_BS", "where the sensor sits on the body");
  const YamlMapping transform = sensor.sub("T_BS", {});
  const auto values = transform.numbers("data", 16, "16 numbers, a 4x4 matrix by rows");
  const Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> matrix(values.data());
  constexpr double kMaxDeviation = 0.01;  // rounding passes, another layout does not
  const Eigen::Matrix3d rotation = matrix.topLeftCorner<3, 3>();
  transform.check(deviation_from_rotation(rotation) <= kMaxDeviation, "data",
                  "a rotation in the first three rows and columns");
  transform.check((matrix.row(3) - Eigen::RowVector4d(0, 0, 0, 1)).isZero(1e-6), "data",
                  "a last row 0 0 0 1, the translation in the last column,");
  return {nearest_rotation(rotation), matrix.topRightCorner<3, 1>()};
}

}  // namespace cairn
