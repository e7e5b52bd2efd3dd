// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "cairn/survey/frames.h"
#include "cairn/survey/tracks.h"

namespace cairn {

// Given poses jitter: their stamps are rounded, their rate is not the camera's, and at 10 m/s a millisecond
// is a centimetre, which a near landmark sees as a pixel. Where the camera was on the whole only they know;
// how it moved from one frame to the next the images know better. So each pose becomes the mean of its
// neighbours', carried to its frame by the motions that the images show, weighted by what both are worth.
// Poses without jitter stay as they are.

/// The camera's motion since the frame before `frame`, from the tracks that `matches` find in it, where its
/// odometry is about right; nothing where too few agree on one.
[[nodiscard]] std::optional<VisualMotion> measure_motion(const Rig& rig, const FrameBuffer& frames,
                                                         std::span<const Track> tracks,
                                                         const SurveyFrame& frame,
                                                         std::span<const TrackMatch> matches);

/// The pose of frame `id` from the given ones of at most `reach` frames on either side, as far as measured
/// motions lead. With motions m_k and given poses P_k, the errors e_k = log((P_k-1^-1 P_k)^-1 m_k) have the
/// variance 2 s^2 + v, where v is the motions' own and s the given poses', which follows; the mean is then
/// the best of given poses with that variance that motions join, for rotation and translation each.
[[nodiscard]] WorldFromCamera smoothed_pose(const FrameBuffer& frames, KeyframeId id, int reach);

/// The cameras of all frames in the buffer for a landmark that was seen around frame `middle`, whose
/// smoothed_pose holds. Each of the others lies where motions from there lead (variance k v), and where its
/// given pose is (variance s^2), by their weights: what the poses drift within a landmark's life does not
/// blur it.
[[nodiscard]] std::vector<CameraFromWorld> cameras_around(const FrameBuffer& frames, KeyframeId middle,
                                                          int reach);

}  // namespace cairn
