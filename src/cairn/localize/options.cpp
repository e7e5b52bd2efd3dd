// SPDX-License-Identifier: Apache-2.0
#include "cairn/localize/options.h"

#include <algorithm>
#include <cmath>

#include "cairn/core/parameter.h"
#include "cairn/image/resize.h"

namespace cairn {

namespace {

void visit(TrustOptions& trust, ParameterVisitor& visitor) {
  visitor.parameter({"trust.min_inliers", at_least(4, "inliers"), "Fewest inliers of a good pose."},
                    trust.min_inliers);
  visitor.parameter(
      {"trust.min_independent", from(0, "a number of inliers"),
       "Fewest inliers that were matched by descriptor alone, not around a predicted position."},
      trust.min_independent);
  visitor.parameter({"trust.min_cells", from_to(1, 16, "cells"),
                     "Fewest cells with an inlier, of 4 x 4 that the image is cut into."},
                    trust.min_cells);
  visitor.parameter({"trust.max_gdop", above(0, "metres per pixel"),
                     "Largest geometric dilution of precision: error of the position for a pixel of noise in "
                     "every observation."},
                    trust.max_gdop);
  visitor.parameter(
      {"trust.max_position", above(0, "metres"), "Largest protection level of the position along an axis."},
      trust.max_position);
  visitor.parameter({"trust.max_angle_deg", above(0, "degrees"), "Largest protection level of the rotation."},
                    trust.max_angle_deg);
  visitor.parameter({"trust.max_acceleration", above(0, "m/s^2"),
                     "Largest acceleration between poses in a row, of images with times."},
                    trust.max_acceleration);
  visitor.parameter({"trust.max_angular_acceleration", above(0, "rad/s^2"),
                     "Largest angular acceleration between poses in a row, of images with times."},
                    trust.max_angular_acceleration);
}

}  // namespace

void visit(LocalizeOptions& options, ParameterVisitor& visitor) {
  visitor.parameter({"keyframes", at_least(1, "keyframe"),
                     "Keyframes that look most like the image, whose landmarks are looked for."},
                    options.keyframes);
  visitor.parameter({"more_keyframes", from(0, "a number of keyframes"),
                     "Further keyframes tried if those lead to no good pose."},
                    options.more_keyframes);
  visitor.parameter({"nearby_keyframes", from(0, "a number of keyframes"),
                     "Keyframes around a pose that was found, whose landmarks are looked for as well."},
                    options.nearby_keyframes);
  visitor.parameter({"max_ratio", above_up_to(0, 1, "a ratio"),
                     "Largest distance of the nearest descriptor relative to that of the second nearest."},
                    options.max_ratio);
  visitor.parameter({"prior_radius_px", above(0, "pixels"),
                     "Search radius around the position of a landmark by a prior pose."},
                    options.prior_radius_px);
  visitor.parameter({"radius_px", above(0, "pixels"),
                     "Search radius around the position of a landmark by a pose found by matching."},
                    options.radius_px);
  visitor.parameter({"ransac_iterations", at_least(1, "iteration"),
                     "Samples of three matches that are tried: 1000 are enough for 15 % inliers."},
                    options.ransac_iterations);
  visit(options.trust, visitor);
}

void LocalizeOptions::validate() const {
  check_ranges(*this);
}

ObserverOptions observer_options_for(const MapInfo& map, int features, double contrast) {
  ObserverOptions options;
  options.features.descriptor = map.descriptor.name;
  options.features.detector = map.descriptor.name;
  options.features.count = features;
  options.features.contrast = contrast;
  options.depth_noise.baseline = map.rig.baseline;
  // the noise that frames of one drive show lacks what they have in common
  DisparityNoise& noise = options.depth_noise.stated;
  noise = map.depth_noise.value_or(kKinectNoise);
  noise.sigma_px = std::max(noise.sigma_px, kKinectNoise.sigma_px);
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
