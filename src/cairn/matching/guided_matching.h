// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <vector>

#include "cairn/core/executor.h"
#include "cairn/features/features.h"
#include "cairn/geometry/camera.h"
#include "cairn/geometry/rigid3.h"
#include "cairn/matching/matching.h"

namespace cairn {

/// Features of an image without distortion: `camera` is a pinhole.
struct CameraFeatures {
  const Camera& camera;
  const Features& features;
};

struct EpipolarMatchOptions {
  double band_px = 2;  ///< largest distance from the epipolar line, times the larger of both keypoints' sigma
  double min_depth = 0;  ///< of the point in the query's camera, in the unit of the translation
  double max_depth = std::numeric_limits<double>::infinity();
  double max_size_ratio =
      2;  ///< of the keypoints' sizes; depth changes more between any two views than in stereo
  MatchOptions matching{std::numeric_limits<double>::infinity(), 0, true};

  /// PreconditionError for limits without meaning.
  void validate() const;
};

/// Matches of two views with a known relative pose, ordered by query: nearest among the trains that show a
/// point on the query's ray, in front of both cameras and within the depth limits. For the query's ray r (z =
/// 1) and depth z, the train's pixel is that of R r + t / z; the z that suits a train best (least squares,
/// within the limits) must leave it at most the band away. This holds for a pure rotation, too, where the
/// line is a point. A keypoint that is not finite matches nothing. The same bits at any number of threads and
/// on every processor. PreconditionError where a camera has distortion or the descriptors differ.
[[nodiscard]] std::vector<Match> match_along_epipolar_lines(const CameraFeatures& query,
                                                            const CameraFeatures& train,
                                                            const Rigid3& train_from_query,
                                                            const EpipolarMatchOptions& options,
                                                            const Executor& executor = Executor());

/// Where a landmark should be seen.
struct SearchWindow {
  double u = 0, v = 0;   ///< pixels
  double radius_px = 0;  ///< of the window around it
  double min_size = 0;   ///< of the keypoint that may show it, pixels
  double max_size = std::numeric_limits<double>::infinity();
};

/// Matches landmarks, given by predicted places and descriptors in the same order, with the keypoints within
/// their windows. Match::query is the landmark; mutual means that a keypoint goes to the nearest of the
/// landmarks that it could be. A place that is not finite matches nothing. The same bits at
/// any number of threads and on every processor.
/// PreconditionError where there are not as many descriptors as places, or the descriptors differ.
[[nodiscard]] std::vector<Match> match_predicted(const std::vector<SearchWindow>& places,
                                                 const Descriptors& descriptors, const Features& features,
                                                 const MatchOptions& options,
                                                 const Executor& executor = Executor());

}  // namespace cairn
