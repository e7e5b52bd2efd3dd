// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>

#include "cairn/geometry/camera.h"
#include "cairn/geometry/framed.h"

namespace cairn {

using LeftFromRight = Transform<frame::Left, frame::Right>;

/// Two cameras that are fixed to each other, as they are: any models, any sizes.
struct StereoPair {
  Camera left, right;
  LeftFromRight left_from_right;  ///< metres
};

enum class RectificationStatus {
  ok,
  no_baseline,     ///< both cameras are in one place, or a number is none
  right_is_left,   ///< the right camera is to the left of the left one
  no_common_view,  ///< what one camera sees the other cannot; as one behind the other, or facing apart
};

/// Two pinhole cameras with the centres of a pair, turned so that both have the same intrinsics and axes and
/// that x points from the left centre to the right one: a point has the same row in both images and the
/// disparity fx * baseline / z.
struct StereoRectification {
  RectificationStatus status = RectificationStatus::no_baseline;  ///< the rest holds with ok only
  Camera camera;                                                  ///< both rectified cameras; fx = fy
  double baseline = 0;                                            ///< metres
  Eigen::Quaterniond rectified_from_left = Eigen::Quaterniond::Identity();
  Eigen::Quaterniond rectified_from_right = Eigen::Quaterniond::Identity();
};

/// The turn about the baseline is free (Fusiello, Trucco, Verri 2000, "A compact algorithm for rectification
/// of stereo pairs", sec. 3); here z is as near to both optical axes as it can be, which distorts least.
/// Focal length and centre are chosen so that every pixel is seen by both raw cameras, with the widest view
/// of which this holds, as long as the middle of the images keeps at least 4/5 of its resolution. The size is
/// the left camera's, lying on its side where the baseline is more vertical than horizontal.
[[nodiscard]] StereoRectification rectify_stereo(const StereoPair& pair);

}  // namespace cairn
