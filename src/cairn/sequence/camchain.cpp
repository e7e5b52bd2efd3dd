// SPDX-License-Identifier: Apache-2.0
// Kalibr's camchain: cam0, cam1, ..., each with its intrinsics, and where it is seen from the one before
// (T_cn_cnm1) and from the IMU (T_cam_imu, or T_imu_cam as OpenVINS has it).
#include <fmt/format.h>

#include "cairn/core/error.h"
#include "cairn/sequence/calibration_formats.h"

namespace cairn {
namespace {

Camera read_camera(const YamlMapping& mapping) {
  const SourceLocation place{mapping.file(), mapping.line()};
  Camera camera;
  const auto model = mapping.get<std::string>("camera_model", "a camera model");
  if (model != "pinhole") {
    throw InputError({place.file, place.line, "camera_model pinhole", fmt::format("'{}'", model),
                      "Calibrate again with --models pinhole-radtan, or pinhole-equi for a fisheye lens."});
  }
  const auto intrinsics = mapping.numbers("intrinsics", 4, "four numbers: fu fv pu pv in pixels");
  camera.fx = intrinsics[0];
  camera.fy = intrinsics[1];
  camera.cx = intrinsics[2];
  camera.cy = intrinsics[3];
  check_intrinsics(place, camera);
  const auto size = mapping.numbers("resolution", 2, "two whole numbers: width and height in pixels");
  set_image_size(size[0], size[1], place, camera);
  constexpr const char* kModel = "distortion_model";
  constexpr const char* kValues = "distortion_coeffs";
  const auto values = mapping.has(kValues) ? mapping.get<std::vector<double>>(kValues, "a list of numbers")
                                           : std::vector<double>{};
  set_distortion(mapping.get<std::string>(kModel, "a distortion model"), values, place, camera);
  return camera;
}

Rigid3 read_transform(const YamlMapping& mapping, const std::string& key) {
  constexpr const char* kKind = "a 4x4 matrix by rows";
  const auto rows = mapping.get<std::vector<std::vector<double>>>(key, kKind);
  mapping.check(rows.size() == 4, key, kKind);
  Eigen::Matrix4d matrix;
  for (Eigen::Index i = 0; i < 4; ++i) {
    const auto& row = rows[static_cast<std::size_t>(i)];
    mapping.check(row.size() == 4, key, kKind);
    for (Eigen::Index j = 0; j < 4; ++j) matrix(i, j) = row[static_cast<std::size_t>(j)];
  }
  mapping.check((matrix.row(3) - Eigen::RowVector4d(0, 0, 0, 1)).isZero(1e-6), key,
                "a last row 0 0 0 1, the translation in the last column,");
  return transform_of(matrix.topLeftCorner<3, 3>(), matrix.topRightCorner<3, 1>(),
                      {mapping.file(), mapping.line()});
}

std::optional<Rigid3> body_from_camera(const YamlMapping& camera) {
  if (camera.has("T_cam_imu")) return read_transform(camera, "T_cam_imu").inverse();
  if (camera.has("T_imu_cam")) return read_transform(camera, "T_imu_cam");
  return std::nullopt;
}

/// By the chain, else by the places of both on the body.
LeftFromRight left_from_right(const YamlMapping& left, const YamlMapping& right) {
  const auto body_from_left = body_from_camera(left), body_from_right = body_from_camera(right);
  if (right.has("T_cn_cnm1") || !body_from_left || !body_from_right)
    return LeftFromRight(read_transform(right, "T_cn_cnm1").inverse());
  return LeftFromRight(body_from_left->inverse() * *body_from_right);
}

}  // namespace

Calibration read_camchain(const YamlMapping& mapping) {
  const YamlMapping left = mapping.sub("cam0", {});
  Calibration calibration;
  calibration.camera = read_camera(left);
  calibration.body_from_camera = body_from_camera(left);
  if (!mapping.has("cam1")) return calibration;
  const YamlMapping right = mapping.sub("cam1", {});
  set_raw_stereo({calibration.camera, read_camera(right), left_from_right(left, right)},
                 {right.file(), right.line()}, calibration);
  return calibration;
}

}  // namespace cairn
