// SPDX-License-Identifier: Apache-2.0
#include "cairn/localize/options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cairn/core/error.h"
#include "cairn/core/parameter.h"

namespace cairn {
namespace {

bool is_near(double a, double b, double scale) {
  constexpr double kShare = 0.01;
  return std::abs(a - b) <= kShare * scale;
}

std::string describe(const Rig& rig, int width, int height) {
  return fmt::format("{}x{} fx {:.6g} fy {:.6g} cx {:.6g} cy {:.6g}", width, height, rig.fx, rig.fy, rig.cx,
                     rig.cy);
}

}  // namespace

void LocalizeOptions::validate() const {
  check_parameter(keyframes >= 1, "keyframes", "at least 1", keyframes);
  check_parameter(more_keyframes >= 0, "more_keyframes", "at least 0", more_keyframes);
  check_parameter(max_ratio > 0 && max_ratio <= 1, "max_ratio", "above 0, at most 1", max_ratio);
  check_parameter(is_positive(prior_radius_px), "prior_radius_px", "above 0", prior_radius_px);
  check_parameter(is_positive(radius_px), "radius_px", "above 0", radius_px);
  check_parameter(nearby_keyframes >= 0, "nearby_keyframes", "at least 0", nearby_keyframes);
  check_parameter(ransac_iterations >= 1, "ransac_iterations", "at least 1", ransac_iterations);
  check_parameter(trust.min_inliers >= 4, "trust.min_inliers", "at least 4", trust.min_inliers);
  check_parameter(trust.min_independent >= 0, "trust.min_independent", "at least 0", trust.min_independent);
  check_parameter(trust.min_cells >= 1 && trust.min_cells <= 16, "trust.min_cells", "1 to 16",
                  trust.min_cells);
  check_parameter(is_positive(trust.max_gdop), "trust.max_gdop", "above 0", trust.max_gdop);
  check_parameter(is_positive(trust.max_position), "trust.max_position", "above 0", trust.max_position);
  check_parameter(is_positive(trust.max_angle_deg), "trust.max_angle_deg", "above 0", trust.max_angle_deg);
  check_parameter(is_positive(trust.max_acceleration), "trust.max_acceleration", "above 0",
                  trust.max_acceleration);
  check_parameter(is_positive(trust.max_angular_acceleration), "trust.max_angular_acceleration", "above 0",
                  trust.max_angular_acceleration);
}

ObserverOptions observer_options_for(const MapInfo& map, int features, double contrast) {
  ObserverOptions options;
  options.features.descriptor = map.descriptor.name;
  options.features.detector = map.descriptor.name;
  options.features.count = features;
  options.features.contrast = contrast;
  options.depth_noise.baseline = map.rig.baseline;
  return options;
}

void require_same_camera(const MapInfo& map, const QueryCamera& camera, const std::string& source) {
  const bool same_size =
      map.width == 0 || camera.width == 0 || (map.width == camera.width && map.height == camera.height);
  const Rig &a = map.rig, &b = camera.rig;
  const double scale = std::max(a.fx, a.fy);
  if (same_size && is_near(a.fx, b.fx, scale) && is_near(a.fy, b.fy, scale) && is_near(a.cx, b.cx, scale) &&
      is_near(a.cy, b.cy, scale))
    return;
  throw InputError({source, 0, "the camera of the map: " + describe(a, map.width, map.height),
                    describe(b, camera.width, camera.height),
                    "Give the calibration by --camera FILE; images of another camera by --any-camera."});
}

}  // namespace cairn
