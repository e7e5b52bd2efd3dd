// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "cairn/core/executor.h"
#include "cairn/observe/frame_observer.h"
#include "cairn/optimize/disparity_calibration.h"
#include "cairn/optimize/disparity_noise_estimate.h"
#include "cairn/sequence/given_poses.h"
#include "cairn/survey/options.h"

namespace cairn {

/// Maps a small part of a stereo sequence by its given poses, and estimates the field of its disparities:
/// with the poses known, what disparities are wrong by shows in every track. Poses that state deviations are
/// free within these, others are held. Takes stretches of ten frames, evenly over the sequence, a tenth of
/// its frames, 20 to 60. A wrong baseline, or a wrong scale of held poses, is taken for a field as far as it
/// looks like one. Frames that cannot be read or have no pose are left out. `self_calibration` "off"
/// estimates nothing, "report" applies nothing; whether it is to be applied is said in the result.
/// Deterministic at any number of threads.
[[nodiscard]] DisparityCalibration calibrate_by_poses(const Sequence& sequence, const GivenPoses& poses,
                                                      const SurveyOptions& options, const Executor& executor);

/// Estimates the noise of an RGB-D sequence's depth (estimate_disparity_noise) from the same stretches, with
/// the poses as there; the jitter of held poses is part of it. Returns nullopt if the options state it, for a
/// stereo sequence, and if the stretches do not show it. Deterministic at any number of threads.
[[nodiscard]] std::optional<DisparityNoiseEstimate> depth_noise_by_poses(const Sequence& sequence,
                                                                         const GivenPoses& poses,
                                                                         const SurveyOptions& options,
                                                                         const Executor& executor);

}  // namespace cairn
