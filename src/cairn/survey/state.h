// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "cairn/map_files/map_writer.h"
#include "cairn/survey/landmarks.h"
#include "cairn/survey/survey.h"

namespace cairn {

/// All that mapping knows between two frames; the rest is on disk.
struct SurveyState {
  std::size_t next_in_sequence = 0;  ///< the first frame of the sequence that was not looked at
  KeyframeId next_frame{0};
  LandmarkId next_landmark{0};
  FrameBuffer frames;                   ///< those that tracks or landmarks below have seen, and the window
  std::vector<Track> tracks;            ///< of the window
  std::vector<SurveyLandmark> pending;  ///< cleaned, and still to be compared with later ones
  VarianceModel variance;
  SurveyCounts counts;
};

}  // namespace cairn
