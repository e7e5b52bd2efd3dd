// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "cairn/sequence/calibration.h"
#include "cairn/sequence/sequence.h"

namespace cairn {

/// Parses the numbers of a pinhole camera as --camera has them, fx,fy,cx,cy in pixels or fx,fy,cx,cy,scale
/// with the units of depth in a metre. Returns nullopt for a text without a comma. Throws InputError for
/// other numbers, and for focal lengths and scales that are not above 0.
[[nodiscard]] std::optional<CameraParameters> parse_camera_numbers(const std::string& text);

/// Returns whether --camera has the numbers of a pinhole camera, which complete the calibration of folder or
/// format, and names no file.
[[nodiscard]] bool gives_numbers(const std::string& camera);

/// Returns the calibration that --camera names: a file, a known camera, or numbers, which make a pinhole
/// camera without a size. Throws InputError for anything else.
[[nodiscard]] Calibration read_named_calibration(const std::string& camera);

}  // namespace cairn
