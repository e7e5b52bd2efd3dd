// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "cairn/map/held_out_frame.h"
#include "cairn/map_files/map_writer.h"
#include "cairn/survey/landmarks.h"
#include "cairn/survey/survey.h"

namespace cairn {

/// Holds the state of mapping between two frames; the rest is on disk.
struct SurveyState {
  std::size_t next_in_sequence = 0;  ///< first frame of the sequence that was not processed
  /// Number that the next frame of the map gets.
  KeyframeId next_frame{0};
  /// Number that the next landmark written gets.
  LandmarkId next_landmark{0};
  FrameBuffer frames;         ///< the window, and frames that a track or a pending landmark was seen in
  std::vector<Track> tracks;  ///< tracks of the window
  /// Tracks that are finished, but were seen in a frame from first_open_pose on.
  std::vector<Track> finished;
  KeyframeId first_open_pose{0};        ///< first frame whose pose may still change
  std::vector<SurveyLandmark> pending;  ///< cleaned landmarks that later ones may be merged with
  VarianceModel variance;
  LandmarkNoiseModel noise;
  SurveyCounts counts;
  std::vector<MoveInSigmas> moves;     ///< of the settled frames whose given poses state deviations
  std::vector<HeldOutFrame> held_out;  ///< frames that were written and located without their observations
};

}  // namespace cairn
