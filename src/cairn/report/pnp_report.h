// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "cairn/geometry/camera_pose.h"
#include "cairn/geometry/pnp_ransac.h"

namespace cairn {

/// Holds how the pose of a camera was found from points and their pixels.
struct PnpReport {
  std::size_t points = 0;
  std::optional<PnpResult> ransac;  ///< nothing: least squares began elsewhere
  std::size_t used = 0;             ///< points that the last least squares used
  PoseEstimate fit;
  RansacReport judged;  ///< of the fit's pose, by all points; if the fit is ok
};

/// Holds what the text says of how the pose was asked for.
struct PnpTextOptions {
  bool trace = false;       ///< print the cost after each step
  bool has_kernel = false;  ///< the cost is with a robust kernel
  double sigma_px = 1;      ///< standard deviation of a pixel
};

/// Says why there is no pose; empty if there is one.
[[nodiscard]] std::string failure_of(const PnpReport& report);

/// Returns counts, cost and pose with its standard deviations, for people; empty if least squares never ran.
[[nodiscard]] std::string format_pnp_text(const PnpReport& report, const PnpTextOptions& options);
/// Returns the same as a JSON object, numbers in full: the pose is a 3 x 4 matrix camera_from_world, the
/// covariance that of its left perturbation, rotation first (radians, metres).
[[nodiscard]] std::string format_pnp_json(const PnpReport& report);

}  // namespace cairn
