// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cairn/features/extractor.h"
#include "cairn/map/keyframe_map.h"
#include "cairn/sequence/sequence.h"
#include "cairn/slam/options.h"

namespace cairn {

/// The rig that observations are made for: the undistorted camera and the depth noise's virtual baseline.
[[nodiscard]] Rig rgbd_rig(const Camera& camera, const DepthNoise& noise);

/// Features of a frame as observations (u, v, d) of the rig: pixels undistorted, depth read at the nearest
/// pixel. Features that cannot be undistorted are left out; those without depth stay, without disparity and
/// point.
[[nodiscard]] ObservedFrame observe(const Frame& frame, const Camera& camera, const Extractor& extractor,
                                    const DepthNoise& noise);

}  // namespace cairn
