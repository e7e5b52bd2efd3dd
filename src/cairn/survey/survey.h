// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "cairn/core/executor.h"
#include "cairn/core/progress.h"
#include "cairn/sequence/given_poses.h"
#include "cairn/sequence/sequence.h"
#include "cairn/survey/cleaning.h"
#include "cairn/survey/options.h"
#include "cairn/survey/pose_check.h"
#include "cairn/survey/variance_model.h"

namespace cairn {

/// What became of frames, features and landmarks.
struct SurveyCounts {
  std::int64_t frames = 0;                ///< in the map
  std::int64_t without_pose = 0;          ///< left out: no given pose near in time
  std::int64_t stationary = 0;            ///< left out: the view did not change
  std::int64_t unreadable = 0;            ///< left out: could not be decoded
  std::int64_t features = 0;              ///< found, in the left images of frames in the map
  std::int64_t measured = 0;              ///< of these with a disparity or depth
  std::int64_t matched = 0;               ///< of these, to a track of the window
  std::int64_t tracks = 0;                ///< that were finished
  std::int64_t too_short = 0;             ///< of these, in too few frames
  std::int64_t inconsistent = 0;          ///< tracks whose observations do not agree with one point
  std::int64_t dropped_observations = 0;  ///< of landmarks: did not agree with the others
  CleaningCounts cleaned = {};            ///< landmarks that fell to each rule
  std::int64_t merged = 0;                ///< landmarks that were another one's
  std::int64_t landmarks = 0;             ///< in the map
  std::int64_t observations = 0;          ///< of these
  std::int64_t dominated_by_poses = 0;  ///< of these: the poses' stated deviations add more than images leave
  /// Sums over the landmarks in the map of the variance along the worst direction, square metres.
  double image_variance_m2 = 0, pose_variance_m2 = 0;
  double moved_squared_m = 0, turned_squared_rad = 0;  ///< sums over the frames: by smoothed_pose
};

/// Seconds by stage. Decoding and features run beside the others, on all threads.
struct SurveyTimes {
  double decode = 0, features = 0, matching = 0, adjustment = 0, merging = 0, writing = 0;
};

/// Median over the frames of the standard deviations that their poses state, along the worst direction; 0 if
/// they state none.
struct StatedDeviations {
  double position_m = 0, rotation_deg = 0;
};

struct SurveyResult {
  SurveyCounts counts;
  SurveyTimes times;            ///< of this run, without those that it goes on from
  std::int64_t resumed_at = 0;  ///< frames of the sequence that an earlier run had done
  VariancePrior noise;          ///< how noisy observations were, in units of the sigmas assumed
  double moved_rms_m = 0, turned_rms_deg = 0;  ///< smoothed poses from given ones
  /// Root mean square over the landmarks of their standard deviation along the worst direction, metres: by
  /// what the images leave open, and by what the poses' stated deviations add.
  double image_std_rms_m = 0, pose_std_rms_m = 0;
  StatedDeviations stated;  ///< of the given poses
  PoseCheck pose_check;     ///< given poses against the images
  bool stopped = false;     ///< the user stopped; the work so far is kept
};

/// What is mapped.
struct SurveyInput {
  const Sequence& sequence;  ///< stereo or RGB-D
  const GivenPoses& poses;   ///< of its frames
  std::string
      settings;  ///< the options as text: goes into the map, and two runs of other settings do not mix
};

/// Mapping with known poses: observes each frame, matches it to the tracks of a sliding window, adjusts each
/// track's landmark when it has left the window, cleans, merges duplicates, and writes the map piece by piece
/// into `folder`, which exists: memory does not grow with the length of the drive.
///
/// Now and then it keeps a record of its state beside the pieces. If `folder` holds one of the same input, it
/// goes on from there, and the map becomes the same, byte for byte. The same bytes at any number of threads.
/// The folder holds a map when the result is not `stopped`, else what is to be gone on with.
///
/// InputError for a sequence that is neither stereo nor RGB-D, for options out of range, for poses that the
/// images show to be misread (see check_poses), and if no landmark can be made because no frame can be read.
/// A frame that cannot be decoded is reported and left out. Work that a failed run came from is discarded,
/// and so is what a run kept that failed for a reason of its own, so that the next one begins anew.
[[nodiscard]] SurveyResult run_survey(const SurveyInput& input, const SurveyOptions& options,
                                      const std::filesystem::path& folder, const Executor& executor,
                                      Progress& progress);

/// Whether there is something in the folder that a run can go on with.
[[nodiscard]] bool has_unfinished_survey(const std::filesystem::path& folder);

}  // namespace cairn
