// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "cairn/localize/common_error.h"
#include "cairn/localize/matches.h"
#include "cairn/localize/options.h"
#include "cairn/localize/precision.h"

namespace cairn {

/// Says how far the pose of an image can be trusted; none: no pose.
enum class Verdict { none, weak, good };

/// Says why a pose is weak.
enum class Weakness {
  nothing,
  few_inliers,       ///< too few inliers, or too few independent ones (Localization::independent)
  bad_geometry,      ///< inliers in too small a part of the image, or too large a dilution of precision
  large_covariance,  ///< a protection level above its limit
  inconsistent_with_motion,  ///< contradicts the poses before
};

/// Returns "none", "weak" or "good".
[[nodiscard]] std::string_view to_string(Verdict verdict);
/// Returns the reason in words, such as "few inliers"; empty for Weakness::nothing.
[[nodiscard]] std::string_view to_string(Weakness weakness);

/// Holds the result of localising one image. If there is no pose, only the verdict and the matches mean
/// anything.
struct Localization {
  Verdict verdict = Verdict::none;
  Weakness weakness = Weakness::nothing;
  CameraFromWorld camera_from_world;
  Precision precision;
  std::vector<LandmarkMatch> matches;  ///< matches that were compared with the pose
  std::vector<std::int32_t> inliers;   ///< positions in `matches`, increasing
  int independent = 0;                 ///< inliers that are first matches, of which RANSAC made the pose
  int cells = 0;                       ///< cells with an inlier, of 4 x 4 that the image is divided into
  double variance_factor = 0;          ///< squared errors over expected ones, see PoseEstimate
  double rms_px = 0;                   ///< RMS residual of (u, v) over the inliers
  bool from_prior = false;             ///< whether it was found from the prior pose

  [[nodiscard]] bool found() const { return verdict != Verdict::none; }
};

/// Localises images in a map: finds keyframes that look alike (or are near a prior pose), matches the image
/// with their landmarks, solves P3P in RANSAC, searches for more matches around that pose, and estimates the
/// pose that explains them best, given the noise of pixels and the covariances of landmarks. Poses are in the
/// world of the map's largest component.
///
/// Holds a reference to the map, which must live as long. Safe to use from several threads at once. The
/// result depends on the image, the prior and the seed alone.
class Localizer {
 public:
  /// Throws InputError for options out of range, and PreconditionError if the size or the focal lengths of
  /// the camera are not known.
  Localizer(const StoredMap& map, const QueryCamera& camera, const LocalizeOptions& options);

  /// Localises an image whose observations are of the camera's rig. Searches the whole map if the prior pose
  /// does not lead to a good pose.
  [[nodiscard]] Localization localize(const ObservedFrame& observed,
                                      const std::optional<WorldFromCamera>& prior = {}) const;

 private:
  [[nodiscard]] Localization localize_near(const ObservedFrame& observed, const WorldFromCamera& prior) const;
  [[nodiscard]] Localization localize_anywhere(const ObservedFrame& observed) const;
  [[nodiscard]] Localization refine(const ObservedFrame& observed, const std::vector<LandmarkMatch>& matches,
                                    Keyframes keyframes) const;
  /// Holds an error that landmarks have in common, in the axes of a keyframe, and how a camera is turned to
  /// it.
  struct PlacedError {
    CommonError error;
    Eigen::Quaterniond camera_from_keyframe;
  };
  /// Returns that of the place, or nullopt if the map does not know it.
  [[nodiscard]] std::optional<PlacedError> common_error_near(const CameraFromWorld& camera_from_world) const;
  void judge(Localization& found) const;
  [[nodiscard]] Keyframes load(const std::vector<KeyframeId>& ids) const;

  const StoredMap& map_;
  QueryCamera camera_;
  LocalizeOptions options_;
  CommonErrors common_errors_;
};

}  // namespace cairn
