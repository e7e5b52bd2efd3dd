// SPDX-License-Identifier: Apache-2.0
// Private to this room: calibrations as other programs write them.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cairn/geometry/camera.h"
#include "cairn/geometry/rigid3.h"
#include "cairn/sequence/calibration.h"
#include "cairn/sequence/yaml_mapping.h"

namespace cairn {

/// Reads a calibration of another program, recognised by its content: OpenCV's and ROS's YAML, Kalibr's
/// camchain, COLMAP's cameras.txt, JSON of RealSense and Open3D. Returns nullopt if it is none of these.
/// Throws InputError for any defect, and for what cairn has no model for.
[[nodiscard]] std::optional<Calibration> read_foreign_calibration(const std::filesystem::path& file);

/// Finds a calibration of another program in a folder under its usual name: left.yaml beside right.yaml,
/// which are a pair; a camchain; camera_info.yaml, ost.yaml, intrinsics.json, cameras.txt ... Returns nullopt
/// if there is none. A pair is returned as its left file.
[[nodiscard]] std::optional<std::filesystem::path> find_foreign_calibration(
    const std::filesystem::path& folder);

/// Returns the other file of a pair of ROS's calibrations, right.yaml for left.yaml, if it exists.
[[nodiscard]] std::optional<std::filesystem::path> right_beside(const std::filesystem::path& left);
/// Reads a pair of ROS's calibrations (left.yaml, right.yaml): raw images, and the rectification that tells
/// where the right camera sits. Throws InputError for any defect.
[[nodiscard]] Calibration read_ros_pair(const std::filesystem::path& left,
                                        const std::filesystem::path& right);

/// Reads the camera of OpenCV's or ROS's YAML, or of RealSense's JSON. Throws InputError for any defect.
[[nodiscard]] Camera read_stated_camera(const YamlMapping& mapping);
/// Tells whether a mapping holds such a camera: a matrix, or focal lengths and a principal point.
[[nodiscard]] bool states_camera(const YamlMapping& mapping);

/// Reads Kalibr's camchain: one camera or the first two as a pair; T_cam_imu says where the body is. Throws
/// InputError for any defect.
[[nodiscard]] Calibration read_camchain(const YamlMapping& mapping);

/// Tells whether a text file is COLMAP's cameras.txt.
[[nodiscard]] bool is_colmap_cameras(const std::filesystem::path& file);
/// Reads COLMAP's cameras.txt; all cameras in it must be alike. Throws InputError for any defect.
[[nodiscard]] Calibration read_colmap_cameras(const std::filesystem::path& file);

/// Sets model and coefficients by another program's name of the model: OpenCV's order k1 k2 p1 p2 k3 ..., or
/// k1 .. k4 of an equidistant fisheye. A model whose coefficients are all 0 is a pinhole, but for the
/// fisheye. Throws InputError that names the model if cairn has none such.
void set_distortion(std::string_view model, const std::vector<double>& values, const SourceLocation& place,
                    Camera& camera);

/// Sets the size. Throws InputError unless both are whole numbers from 1 to 32768.
void set_image_size(double width, double height, const SourceLocation& place, Camera& camera);
/// Throws InputError unless the focal lengths are above 0 and all is finite.
void check_intrinsics(const SourceLocation& place, const Camera& camera);

/// Converts a rotation and a translation. Throws InputError unless the matrix is a rotation within a
/// hundredth.
[[nodiscard]] Rigid3 transform_of(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation,
                                  const SourceLocation& place);

}  // namespace cairn
