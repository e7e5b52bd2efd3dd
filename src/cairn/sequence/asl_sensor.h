// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "cairn/geometry/camera.h"
#include "cairn/geometry/rigid3.h"

namespace cairn {

/// What a `sensor.yaml` of the ASL layout says of a camera (Burri et al. 2016, "The EuRoC micro aerial
/// vehicle datasets"): camera_model pinhole with distortion_model radial-tangential, equidistant or none.
/// InputError with the line for other models and for whatever is missing or no number.
[[nodiscard]] Camera read_asl_camera(const std::filesystem::path& sensor_yaml);

/// T_BS, where a sensor sits on the body; InputError where it is no rigid transform.
[[nodiscard]] Rigid3 read_body_from_sensor(const std::filesystem::path& sensor_yaml);

}  // namespace cairn
