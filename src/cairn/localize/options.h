// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "cairn/core/parameter.h"
#include "cairn/geometry/rig.h"
#include "cairn/map_files/map_info.h"
#include "cairn/observe/observer.h"

namespace cairn {

/// Holds the limits that a good pose must keep.
struct TrustOptions {
  int min_inliers = 50;  ///< fewest inliers; poses wrong by 5 degrees had up to 47 on the recordings tried
  /// Fewest inliers that are first matches, made by descriptor over the whole image or within
  /// prior_radius_px: matches found near the pixels that a pose predicts agree with any pose.
  int min_independent = 20;
  int min_cells = 4;       ///< fewest cells with an inlier, of 4 x 4 that the image is divided into
  double max_gdop = 0.05;  ///< largest dilution of precision, metres per pixel of noise in every observation
  double max_position = 0.5;  ///< largest protection level of the position along an axis, metres
  double max_angle_deg = 5;   ///< largest protection level of the rotation about an axis, degrees
  /// Largest acceleration between successive poses, m/s^2; hand-held cameras and cars have less.
  double max_acceleration = 20;
  double max_angular_acceleration = 60;  ///< between successive poses, rad/s^2
};

/// Holds the options of localising an image in a map.
struct LocalizeOptions {
  /// Number of keyframes, those that look most like the image, whose landmarks are searched for.
  int keyframes = 2;
  int more_keyframes = 14;  ///< further ones tried, `keyframes` at a time, if those lead to no good pose
  /// Largest ratio of the distances to the nearest and the second nearest descriptor.
  double max_ratio = 0.85;
  double prior_radius_px = 40;   ///< search radius around where a prior pose predicts a landmark
  double radius_px = 6;          ///< search radius around where a pose found by matching predicts a landmark
  int nearby_keyframes = 6;      ///< keyframes around a pose found, whose landmarks are searched for as well
  int ransac_iterations = 1000;  ///< samples of three matches; enough for 15 % inliers
  TrustOptions trust;
  std::uint64_t seed = 1;

  /// Throws InputError naming the parameter that is out of range.
  void validate() const;
};

/// Visits the parameters of localisation, in the order of --help.
void visit(LocalizeOptions& options, ParameterVisitor& visitor);

/// Describes the camera of the images to be localised, after camera_for_queries.
struct QueryCamera {
  Rig rig;                    ///< rig that the observations are of
  int width = 0, height = 0;  ///< pixels
};

/// Returns the options of observing images to be localised in this map: with the detector and descriptor of
/// its kind, `features` features, the contrast as in FeatureOptions, and the map's baseline for depth.
[[nodiscard]] ObserverOptions observer_options_for(const MapInfo& map, int features, double contrast);

/// Returns the camera of a query after its images are resized (resized_camera) to the map's pixels per
/// radian, the geometric mean of the focal lengths: descriptors and the expected sizes of features hold for
/// views of like resolution. Images that are within a tenth of it stay as they are, and those with fewer
/// pixels per radian are enlarged at most twice, as enlarging adds no detail.
[[nodiscard]] Camera camera_for_queries(const MapInfo& map, const Camera& camera);

}  // namespace cairn
