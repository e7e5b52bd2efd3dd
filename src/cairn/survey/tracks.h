// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "cairn/map/map.h"
#include "cairn/survey/frames.h"
#include "cairn/survey/options.h"

namespace cairn {

/// Features of several frames that show one thing: a landmark in the making.
struct Track {
  std::vector<ObservationRef> observations;  ///< by frame, increasing, one for each
  ObservationRef measured;                   ///< the latest with a disparity
  /// As that disparity places it, in the world of SurveyFrame::odometry.
  Eigen::Vector3d point_in_world = Eigen::Vector3d::Zero();
};

/// Feature `feature` of the current frame shows what track number `track` shows.
struct TrackMatch {
  std::int32_t track = 0;
  std::int32_t feature = 0;
};

/// Matches the tracks of `frames` with the features of `frame`, which follows them. A track is looked for
/// where the poses and its latest disparity place it, by the descriptor that it had last. A match counts only
/// if it agrees with the epipolar geometry of the two poses, p2^T K^-T [t]x R K^-1 p1 = 0 (distance of p2
/// from the line), and with the depth, in front of both cameras. Ordered by track; a feature goes to one
/// track at most. The same bits at any number of threads.
[[nodiscard]] std::vector<TrackMatch> match_to_tracks(const Rig& rig, const FrameBuffer& frames,
                                                      std::span<const Track> tracks, const SurveyFrame& frame,
                                                      const TrackOptions& options, const Executor& executor);

/// Takes out of a frame what is of no use: features without a disparity that no match needs. The matches
/// follow their features.
void drop_unused_features(SurveyFrame& frame, std::span<TrackMatch> matches);

/// Matched features join their tracks, if these are not full; each of the others begins one, at the end, if
/// it has a disparity.
void extend_tracks(const SurveyFrame& frame, std::span<const TrackMatch> matches, std::vector<Track>& tracks);

/// Takes out, in their order, the tracks that have left the window of frames which ends at `newest`, and
/// those that are full, once the poses of their frames are smooth.
[[nodiscard]] std::vector<Track> extract_finished(KeyframeId newest, const TrackOptions& options,
                                                  std::vector<Track>& tracks);

}  // namespace cairn
