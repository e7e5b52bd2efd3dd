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

/// Refers to the features of an image without distortion: `camera` is a pinhole.
struct CameraFeatures {
  const Camera& camera;
  const Features& features;
};

/// Sets which trains a query may match along its epipolar line.
struct EpipolarMatchOptions {
  double band_px = 2;  ///< largest distance from the epipolar line, times the larger of both keypoints' sigma
  double min_depth = 0;  ///< minimum depth of the point in the query's camera, in the unit of the translation
  /// Maximum depth of the point in the query's camera, in the unit of the translation.
  double max_depth = std::numeric_limits<double>::infinity();
  /// Maximum ratio of the keypoints' sizes; depth changes more between any two views than in stereo.
  double max_size_ratio = 2;
  MatchOptions matching{std::numeric_limits<double>::infinity(), 0, true};

  /// Throws PreconditionError if a limit is out of range.
  void validate() const;
};

/// Matches two views with a known relative pose, ordered by query: the nearest among the trains that show a
/// point on the query's ray, in front of both cameras and within the depth limits. For the query's ray r (z =
/// 1) and depth z, the train's pixel is that of R r + t / z; at the z that fits a train best (least squares,
/// within the limits) the train may be at most the band away. This also holds for a pure rotation, for which
/// the line is a point. A keypoint that is not finite matches nothing. Gives the same bits at any number of
/// threads and on every processor. Throws PreconditionError if a camera has distortion, an option is out of
/// range, or the kinds of descriptor differ.
[[nodiscard]] std::vector<Match> match_along_epipolar_lines(const CameraFeatures& query,
                                                            const CameraFeatures& train,
                                                            const Rigid3& train_from_query,
                                                            const EpipolarMatchOptions& options,
                                                            const Executor& executor = Executor());

/// Describes the window in which a landmark should be seen.
struct SearchWindow {
  double u = 0, v = 0;   ///< centre, pixels
  double radius_px = 0;  ///< radius around the centre
  double min_size = 0;   ///< minimum size of a keypoint that may show the landmark, pixels
  /// Maximum size of a keypoint that may show the landmark, pixels.
  double max_size = std::numeric_limits<double>::infinity();
};

/// Matches landmarks, given by windows and descriptors in the same order, with the keypoints within their
/// windows. Match::query is the landmark; mutual means that a keypoint is matched with the nearest of the
/// landmarks whose windows hold it. A window that is not finite matches nothing. Gives the same bits at any
/// number of threads and on every processor. Throws PreconditionError if there are not as many descriptors as
/// windows, an option is out of range, or the kinds of descriptor differ.
[[nodiscard]] std::vector<Match> match_predicted(const std::vector<SearchWindow>& places,
                                                 const Descriptors& descriptors, const Features& features,
                                                 const MatchOptions& options,
                                                 const Executor& executor = Executor());

}  // namespace cairn
