// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "cairn/core/parameter.h"
#include "cairn/geometry/rig.h"
#include "cairn/map_files/map_info.h"
#include "cairn/observe/observer.h"

namespace cairn {

/// When a pose is called good.
struct TrustOptions {
  int min_inliers = 50;  ///< poses that were wrong by 5 degrees had up to 47 on the recordings tried
  /// Of them, matches by descriptor alone: those found around a predicted place agree with any pose.
  int min_independent = 20;
  int min_cells = 4;             ///< of 4 x 4 that the image is cut into, with an inlier
  double max_gdop = 0.05;        ///< metres per pixel of noise in every observation
  double max_position = 0.5;     ///< metres: largest protection level of an axis
  double max_angle_deg = 5;      ///< degrees: the same of the rotation
  double max_acceleration = 20;  ///< m/s^2 between poses in a row: hand-held cameras and cars have less
  double max_angular_acceleration = 60;  ///< rad/s^2
};

/// Finding the pose of an image in a map.
struct LocalizeOptions {
  int keyframes = 2;             ///< that look most like the image, whose landmarks are looked for
  int more_keyframes = 14;       ///< tried, as many at a time, when those do not lead to a good pose
  double max_ratio = 0.85;       ///< of the distances of the nearest and the second nearest descriptor
  double prior_radius_px = 40;   ///< how far landmarks may lie from where a prior pose has them
  double radius_px = 6;          ///< the same for a pose found by matching
  int nearby_keyframes = 6;      ///< around the pose, whose landmarks are looked for as well
  int ransac_iterations = 1000;  ///< of samples of three: enough for 15 % inliers
  TrustOptions trust;
  std::uint64_t seed = 1;

  /// Throws InputError naming the parameter that is out of range.
  void validate() const;
};

/// Visits the parameters of localisation, in the order of --help.
void visit(LocalizeOptions& options, ParameterVisitor& visitor);

/// The camera that an image to be localised was seen by, as the image is observed: after camera_for_queries.
struct QueryCamera {
  Rig rig;                    ///< that the image's observations are of
  int width = 0, height = 0;  ///< pixels
};

/// How features are found and described in images that are looked for in this map; `contrast` as in
/// FeatureOptions.
[[nodiscard]] ObserverOptions observer_options_for(const MapInfo& map, int features, double contrast);

/// Returns the camera of a query after its images are resized (resized_camera) to the map's pixels per
/// radian, the geometric mean of the focal lengths: descriptors and the expected sizes of features hold for
/// views of like resolution. Images that are within a tenth of it stay as they are, and those with fewer
/// pixels per radian are enlarged at most twice, as enlarging adds no detail.
[[nodiscard]] Camera camera_for_queries(const MapInfo& map, const Camera& camera);

}  // namespace cairn
