// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "cairn/core/executor.h"
#include "cairn/core/progress.h"
#include "cairn/map/held_out_frame.h"
#include "cairn/observe/row_errors.h"
#include "cairn/optimize/disparity_calibration.h"
#include "cairn/optimize/disparity_noise_estimate.h"
#include "cairn/optimize/landmark_noise.h"
#include "cairn/sequence/given_poses.h"
#include "cairn/sequence/sequence.h"
#include "cairn/survey/cleaning.h"
#include "cairn/survey/options.h"
#include "cairn/survey/pose_check.h"

namespace cairn {

/// Limits of SurveyCounts::beyond, pixels.
inline constexpr std::array<int, 3> kBeyondPx{2, 4, 10};

/// Counts what became of frames, features and landmarks.
struct SurveyCounts {
  std::int64_t frames = 0;                ///< frames in the map
  std::int64_t without_pose = 0;          ///< frames left out: no given pose near in time
  std::int64_t stationary = 0;            ///< frames left out: the view did not change
  std::int64_t unreadable = 0;            ///< frames left out: could not be decoded
  std::int64_t features = 0;              ///< features found in the left images of frames in the map
  std::int64_t measured = 0;              ///< features with a disparity or depth
  std::int64_t matched = 0;               ///< features matched to a track of the window
  std::int64_t tracks = 0;                ///< tracks that were finished
  std::int64_t too_short = 0;             ///< tracks of too few frames
  std::int64_t inconsistent = 0;          ///< tracks whose observations do not agree with one point
  std::int64_t dropped_observations = 0;  ///< observations of landmarks that did not agree with the others
  CleaningCounts cleaned = {};            ///< landmarks that failed each rule
  std::int64_t merged = 0;                ///< landmarks merged with another one
  std::int64_t landmarks = 0;             ///< landmarks in the map
  std::int64_t observations = 0;          ///< observations of landmarks in the map
  /// Observations of landmarks in the map that lie, by the map's poses, more than kBeyondPx pixels from where
  /// the landmark is projected to.
  std::array<std::int64_t, 3> beyond = {};
  /// Landmarks in the map to which the poses' stated deviations add more than the images leave open.
  std::int64_t dominated_by_poses = 0;
  /// Sums over the landmarks in the map of the variance along the worst direction, square metres: from the
  /// images, and from the poses' stated deviations.
  double image_variance_m2 = 0, pose_variance_m2 = 0;
  /// Sums over the frames of the squared change of the pose by smoothed_pose.
  double moved_squared_m = 0, turned_squared_rad = 0;
};

/// Holds the seconds spent in each stage. Decoding and features run beside the others, on all threads, and
/// are summed over these.
struct SurveyTimes {
  double decode = 0, features = 0, matching = 0, poses = 0, adjustment = 0, merging = 0, writing = 0;
};

/// Holds the medians over the frames of the standard deviations that their poses state, along the worst
/// direction; 0 if they state none.
struct StatedDeviations {
  double position_m = 0, rotation_deg = 0;
};

/// Holds by how many of its stated standard deviations a given pose was moved and turned, each in the
/// direction of the move; 0 where it was not, NaN where it states none.
struct MoveInSigmas {
  double position = 0, rotation = 0;
};

/// Holds the distribution over the frames of MoveInSigmas, those that state deviations; NaN if none does, all
/// 0 without frames.
struct MovesInSigmas {
  std::int64_t frames = 0;  ///< whose poses state standard deviations
  MoveInSigmas median, largest;
};

/// Holds the result of mapping with known poses.
struct SurveyResult {
  SurveyCounts counts;
  SurveyTimes times;            ///< of this run, without runs that it resumes
  std::int64_t resumed_at = 0;  ///< frames of the sequence that earlier runs processed; 0 for a new run
  VariancePrior noise;  ///< how noisy the observations are, in units of the assumed standard deviations
  LandmarkNoise landmark_noise;                ///< what landmarks show of their observations' noise
  double moved_rms_m = 0, turned_rms_deg = 0;  ///< RMS change of poses by smoothing
  /// Root mean square over the landmarks of their standard deviation along the worst direction, metres: from
  /// the images, and from the poses' stated deviations.
  double image_std_rms_m = 0, pose_std_rms_m = 0;
  StatedDeviations stated;             ///< of the given poses
  MovesInSigmas moves;                 ///< by which smoothing changed poses, against what they state
  std::vector<HeldOutFrame> held_out;  ///< frames that were located without their observations
  RowErrors row_errors;                ///< of the right images; all zero if they were not measured
  bool rows_aligned = false;           ///< whether the right images were loaded with their rows corrected
  DisparityCalibration disparity_calibration;  ///< of a stereo pair, by the given poses
  /// Of an RGB-D sequence, by the given poses: how sure its disparities are, and how many say so; 0 if it is
  /// stated or assumed.
  std::optional<DisparityNoiseEstimate> depth_noise;
  PoseCheck pose_check;  ///< given poses against the images
  bool stopped = false;  ///< whether the user stopped the run; the work so far is kept
};

/// Describes what is mapped.
struct SurveyInput {
  const Sequence& sequence;  ///< stereo or RGB-D
  const GivenPoses& poses;   ///< of its frames
  /// The options as text. They are stored in the map; a run with other settings does not resume the work.
  std::string settings;
};

/// Maps a sequence with known poses: observes each frame, matches it to the tracks of a sliding window,
/// adjusts each track's landmark when it has left the window, cleans, merges duplicates, and writes the map
/// piece by piece into `folder`, which exists. Memory does not grow with the length of the drive.
///
/// Every few seconds it keeps a checkpoint beside the pieces. If `folder` holds one of the same input, the
/// run resumes there, and the map becomes the same, byte for byte. The same bytes at any number of threads.
/// The folder holds a map if the result is not `stopped`, else what a later run resumes from.
///
/// Throws InputError for a sequence that is neither stereo nor RGB-D, for options out of range, for poses
/// that the images show to be misread (see check_poses), and if no frame with a pose can be read. A frame
/// that cannot be decoded is reported and left out. The checkpoint is discarded if a run that resumed it
/// fails, or if a run fails by another error than InputError; the next run then starts anew.
[[nodiscard]] SurveyResult run_survey(const SurveyInput& input, const SurveyOptions& options,
                                      const std::filesystem::path& folder, const Executor& executor,
                                      Progress& progress);

/// Returns whether the folder holds a checkpoint that a run may resume.
[[nodiscard]] bool has_unfinished_survey(const std::filesystem::path& folder);

}  // namespace cairn
