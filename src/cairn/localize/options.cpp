// SPDX-License-Identifier: Apache-2.0
#include "cairn/localize/options.h"

#include <algorithm>
#include <cmath>

#include "cairn/core/parameter.h"
#include "cairn/image/resize.h"

namespace cairn {

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

Camera camera_for_queries(const MapInfo& map, const Camera& camera) {
  constexpr double kTolerance = 1.1, kMostEnlarged = 2;
  const double scale = std::sqrt(map.rig.fx * map.rig.fy / (camera.fx * camera.fy));
  if (scale < kTolerance && scale * kTolerance > 1) return camera;
  const auto resized = [&](int side) {
    return std::max(1, static_cast<int>(std::lround(std::min(scale, kMostEnlarged) * side)));
  };
  return resized_camera(camera, resized(camera.width), resized(camera.height));
}

}  // namespace cairn
