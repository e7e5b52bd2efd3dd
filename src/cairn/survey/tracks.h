// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "cairn/map/map.h"
#include "cairn/survey/frames.h"
#include "cairn/survey/options.h"

namespace cairn {

/// Holds the features of several frames that show one thing: a landmark in the making.
struct Track {
  std::vector<ObservationRef> observations;  ///< one for each frame, in ascending order
  ObservationRef measured;                   ///< the latest observation with a disparity
  /// Point by the disparity of `measured`, in the world of SurveyFrame::odometry.
  Eigen::Vector3d point_in_world = Eigen::Vector3d::Zero();
};

/// Says that feature `feature` of the current frame shows the same as track number `track`.
struct TrackMatch {
  std::int32_t track = 0;
  std::int32_t feature = 0;
};

/// Matches the tracks of `frames` with the features of `frame`, which follows them. A track is searched for
/// where the poses and its latest disparity place it, by its latest descriptor. A match counts only if it
/// agrees with the epipolar geometry of the two poses, p2^T K^-T [t]x R K^-1 p1 = 0 (distance of p2 from the
/// line), and with the depth, in front of both cameras. Returns the matches by track; a feature goes to one
/// track at most. The same bits at any number of threads.
[[nodiscard]] std::vector<TrackMatch> match_to_tracks(const Rig& rig, const FrameBuffer& frames,
                                                      std::span<const Track> tracks, const SurveyFrame& frame,
                                                      const TrackOptions& options, const Executor& executor);

/// Removes the features of a frame that have no disparity and no match. The matches follow their features.
void drop_unused_features(SurveyFrame& frame, std::span<TrackMatch> matches);

/// Appends each matched feature to its track; each other feature with a disparity begins a track, at the end.
/// The tracks matched must not be full.
void extend_tracks(const SurveyFrame& frame, std::span<const TrackMatch> matches, std::vector<Track>& tracks);

/// Removes and returns, in their order, the tracks that have left the window of frames that ends at `newest`,
/// and the tracks that are full.
[[nodiscard]] std::vector<Track> extract_finished(KeyframeId newest, const TrackOptions& options,
                                                  std::vector<Track>& tracks);

}  // namespace cairn
