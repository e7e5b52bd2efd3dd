// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "cairn/map/held_out_frame.h"
#include "cairn/survey/landmarks.h"

namespace cairn {

/// Returns whether the frame is one of those that are located without their observations: every third.
[[nodiscard]] bool is_held_out(KeyframeId frame);

/// Solves landmarks again, each time without what one held-out frame shows of them, and adds them to these
/// frames (SurveyFrame::held_out). Landmarks that need the observation are left out.
class HoldOut {
 public:
  /// Refers to its arguments, which must outlive it.
  HoldOut(const Rig& rig, const SurveyOptions& options, const NoisePrior& prior, FrameBuffer& frames);

  void add(const SurveyLandmark& landmark);

 private:
  const Rig& rig_;
  const NoisePrior& prior_;
  FrameBuffer& frames_;
  std::vector<CameraFromWorld> cameras_;
  LandmarkSolver solver_;
  LandmarkFit fit_;
};

/// Estimates the pose of a held-out frame from the landmarks that were added to it, as Localizer does, with
/// standard deviations of `sigma_px` taken off its observations. Returns nullopt if too few agree.
[[nodiscard]] std::optional<HeldOutFrame> locate_held_out(const Rig& rig, const SurveyFrame& frame,
                                                          double sigma_px);

}  // namespace cairn
