// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cairn/survey/state.h"

namespace cairn {

/// Maps with known poses, frame by frame: carries out the stages in their order, see run_survey.
class Surveyor {
 public:
  /// Continues from `state`, with a writer that has come as far.
  Surveyor(const Rig& rig, const SurveyOptions& options, SurveyState&& state, MapWriter& writer);

  /// Processes the next frame. One that does not change the view is counted and left out.
  void add(const ObservedFrame& observed, const GivenPose& given, const Executor& executor);
  /// Makes landmarks of the tracks that are left, and hands all frames and landmarks to the writer. To be
  /// called last.
  void finish(const Executor& executor);

  [[nodiscard]] SurveyState& state() { return state_; }
  /// Returns the times of the stages except decoding and features.
  [[nodiscard]] const SurveyTimes& times() const { return times_; }

 private:
  [[nodiscard]] bool is_stationary(const ObservedFrame& observed, const GivenPose& given) const;
  [[nodiscard]] std::vector<TrackMatch> find_tracks(SurveyFrame& frame, const Executor& executor) const;
  void finish_tracks(KeyframeId newest);
  void settle_poses(KeyframeId first_open, const Executor& executor);
  void count_moved(KeyframeId id);
  void adjust_settled_tracks(const Executor& executor);
  [[nodiscard]] std::vector<SurveyLandmark> clean(std::vector<SurveyLandmark>&& landmarks);
  void write_landmarks(KeyframeId seen_before);
  void write_landmark(const SurveyLandmark& landmark, bool stated);
  void write_frames(KeyframeId before);
  [[nodiscard]] KeyframeId first_open_frame() const;

  Rig rig_;
  SurveyOptions options_;
  SurveyState state_;
  MapWriter& writer_;
  SurveyTimes times_;
};

}  // namespace cairn
