// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "cairn/localize/matches.h"
#include "cairn/localize/options.h"
#include "cairn/localize/precision.h"

namespace cairn {

enum class Verdict { none, weak, good };

/// Why a pose is weak.
enum class Weakness {
  nothing,
  few_inliers,               ///< or too few that were found by descriptor alone
  bad_geometry,              ///< inliers in a part of the image only, or a large dilution of precision
  large_covariance,          ///< the protection level is beyond what is wanted
  inconsistent_with_motion,  ///< with the poses before, or with the prior pose
};

[[nodiscard]] std::string_view to_string(Verdict verdict);
[[nodiscard]] std::string_view to_string(Weakness weakness);

/// What is found out about one image. Without a pose all but the verdict and the counts mean nothing.
struct Localization {
  Verdict verdict = Verdict::none;
  Weakness weakness = Weakness::nothing;
  CameraFromWorld camera_from_world;
  Precision precision;
  std::vector<LandmarkMatch> matches;  ///< all that were compared with the pose
  std::vector<std::int32_t> inliers;   ///< positions in `matches`, increasing
  int independent = 0;         ///< inliers of the matches by descriptor alone, which the pose was made of
  int cells = 0;               ///< of 4 x 4 that the image is cut into, with an inlier
  double variance_factor = 0;  ///< squared errors over expected ones
  double rms_px = 0;           ///< of (u, v) over the inliers
  bool from_prior = false;     ///< the prior pose led to it

  [[nodiscard]] bool found() const { return verdict != Verdict::none; }
};

/// Finds images in a map: frames that look alike (or a prior pose), matches with their landmarks, P3P in
/// RANSAC, more matches around that pose, and the pose that explains them best by the noise of pixels and the
/// covariances of landmarks. Poses are in the world of the map's largest component.
///
/// Made once for a map and a camera, which live as long; may then be used by several threads at once. What is
/// found depends on the image, the prior and the seed alone.
class Localizer {
 public:
  Localizer(const StoredMap& map, const QueryCamera& camera, const LocalizeOptions& options);

  /// `observed` is in the camera's rig. Where the prior pose does not lead to a good one, the whole map is
  /// looked through.
  [[nodiscard]] Localization localize(const ObservedFrame& observed,
                                      const std::optional<WorldFromCamera>& prior = {}) const;

 private:
  [[nodiscard]] Localization localize_near(const ObservedFrame& observed, const WorldFromCamera& prior) const;
  [[nodiscard]] Localization localize_anywhere(const ObservedFrame& observed) const;
  [[nodiscard]] Localization refine(const ObservedFrame& observed, const std::vector<LandmarkMatch>& matches,
                                    Keyframes keyframes) const;
  void judge(Localization& found) const;
  [[nodiscard]] Keyframes load(const std::vector<KeyframeId>& ids) const;

  const StoredMap& map_;
  QueryCamera camera_;
  LocalizeOptions options_;
};

}  // namespace cairn
