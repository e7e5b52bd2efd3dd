// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "cairn/core/executor.h"
#include "cairn/survey/frames.h"
#include "cairn/survey/survey.h"
#include "cairn/survey/tracks.h"

namespace cairn {

// Given poses are measurements: their stamps are rounded, their rate is not the camera's, and at 10 m/s a
// millisecond is a centimetre, which a near landmark shows as a pixel; GNSS wanders. Only the given poses say
// where the camera was on the whole; the images say better how it moved from one frame to the next. So the
// poses of a map are adjusted to both. Given poses that fit the images stay as they are.

/// Measures the camera's motion since the frame before `frame` from the tracks that `matches` find in it; its
/// odometry must be about right. Returns nullopt if too few tracks agree on one motion.
[[nodiscard]] std::optional<VisualMotion> measure_motion(const Rig& rig, const FrameBuffer& frames,
                                                         std::span<const Track> tracks,
                                                         const SurveyFrame& frame,
                                                         std::span<const TrackMatch> matches);

/// Holds the variances of poses and motions: of the rotation (radians squared) and the centre (square metres)
/// about and along the camera's axes.
struct PoseNoise {
  Vector6d given = Vector6d::Zero();   ///< of each given pose: how it jitters from frame to frame, or more
  Vector6d motion = Vector6d::Zero();  ///< of what the images show of the motion between neighbouring frames
  Vector6d formal = Vector6d::Zero();  ///< of the same, as the noise of pixels alone has it
};

/// Measures the noise of frames `first` to `last` by what given and seen motions differ by. With given poses
/// of variance s^2 and seen motions that drift by q a frame, motions over k frames differ by 2 s^2 + k q in
/// the mean square. What they differ by in the mean, frame after frame, is neither: it is a fault of the
/// calibration. Zero if fewer than two motions were measured. Where given poses state larger deviations than
/// they jitter by, the rest is an error that wanders, and `given` is as much larger as lets the poses follow
/// it slowly: how the camera moved from frame to frame is then what the images show, and where it was on the
/// whole what the given poses say.
[[nodiscard]] PoseNoise measure_noise(const FrameBuffer& frames, KeyframeId first, KeyframeId last);

/// Computes by how many standard deviations, as `given` states them, `adjusted` differs from it: along the
/// way between the centres, and about the axis of the turn; infinity along or about an axis that is stated as
/// exact, NaN if all three are, which is no statement. `given` must state its uncertainty.
[[nodiscard]] MoveInSigmas move_in_sigmas(const GivenPose& given, const WorldFromCamera& adjusted);

/// Summarises these; for an even number the larger of the two in the middle is the median.
[[nodiscard]] MovesInSigmas summarise_moves(std::span<const MoveInSigmas> moves);

/// Adjusts world_from_camera of frame `first` and all after it to their given poses and to the images, as
/// `tracks` show them: a bundle adjustment, robust, in which up to `reach` frames before `first` keep their
/// poses. Given poses weigh as measure_noise says. What the images show of a motion is worse than the noise
/// of so many pixels has it, because they share errors; so they weigh less by as much. The same bits at any
/// number of threads.
void adjust_poses(const Rig& rig, std::span<const Track* const> tracks, KeyframeId first, int reach,
                  const Executor& executor, FrameBuffer& frames);

}  // namespace cairn
