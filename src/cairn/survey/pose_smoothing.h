// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "cairn/survey/frames.h"
#include "cairn/survey/tracks.h"

namespace cairn {

// Given poses jitter: their stamps are rounded, their rate is not the camera's, and at 10 m/s a millisecond
// is a centimetre, which a near landmark shows as a pixel. Only the given poses say where the camera was on
// the whole; the images say better how it moved from one frame to the next. So each pose becomes the mean of
// its neighbours', carried to its frame by the motions that the images show, weighted by the precision of
// both. Poses without jitter stay as they are.

/// Measures the camera's motion since the frame before `frame` from the tracks that `matches` find in it; its
/// odometry must be about right. Returns nullopt if too few tracks agree on one motion.
[[nodiscard]] std::optional<VisualMotion> measure_motion(const Rig& rig, const FrameBuffer& frames,
                                                         std::span<const Track> tracks,
                                                         const SurveyFrame& frame,
                                                         std::span<const TrackMatch> matches);

/// Computes the smoothed pose of frame `id` from the given poses of at most `reach` frames on either side, as
/// far as motions were measured. With motions m_k and given poses P_k, the errors e_k = log((P_k-1^-1 P_k)^-1
/// m_k) have the variance 2 s^2 + v, with the motions' own variance v; this yields the given poses' s^2. The
/// result is the best mean of given poses of that variance that motions join, for rotation and translation
/// each.
[[nodiscard]] WorldFromCamera smoothed_pose(const FrameBuffer& frames, KeyframeId id, int reach);

/// Computes the cameras of all frames in the buffer for a landmark that was seen around frame `middle`, whose
/// pose is smoothed already. Each other camera lies between where motions from there lead (variance k v) and
/// its given pose (variance s^2), by their weights, so that drift of the poses within a landmark's life does
/// not blur it.
[[nodiscard]] std::vector<CameraFromWorld> cameras_around(const FrameBuffer& frames, KeyframeId middle,
                                                          int reach);

}  // namespace cairn
