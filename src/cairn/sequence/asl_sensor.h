// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "cairn/geometry/camera.h"
#include "cairn/geometry/rigid3.h"

namespace cairn {

/// Reads the camera of a `sensor.yaml` of the ASL layout (Burri et al. 2016, "The EuRoC micro aerial vehicle
/// datasets"): camera_model pinhole with distortion_model radial-tangential, equidistant or none. Throws
/// InputError with the line for other models and if a value is missing or not a number.
[[nodiscard]] Camera read_asl_camera(const std::filesystem::path& sensor_yaml);

/// Reads T_BS, the pose of a sensor on the body. Throws InputError if it is not a rigid transform.
[[nodiscard]] Rigid3 read_body_from_sensor(const std::filesystem::path& sensor_yaml);

}  // namespace cairn
