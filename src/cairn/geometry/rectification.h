// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>

#include "cairn/geometry/camera.h"
#include "cairn/geometry/framed.h"

namespace cairn {

using LeftFromRight = Transform<frame::Left, frame::Right>;

/// Describes two cameras fixed to each other, before rectification: any models, any sizes.
struct StereoPair {
  Camera left, right;
  LeftFromRight left_from_right;  ///< metres
};

/// Says if a pair can be rectified and, if not, why.
enum class RectificationStatus {
  ok,
  no_baseline,     ///< the cameras coincide, or the baseline is not finite
  right_is_left,   ///< the right camera is to the left of the left one
  no_common_view,  ///< the cameras share no view, for example if one is behind the other or they face apart
};

/// Describes two pinhole cameras with the centres of a pair, rotated so that both have the same intrinsics
/// and axes and that x points from the left centre to the right one: a point has the same row in both images
/// and the disparity fx * baseline / z.
struct StereoRectification {
  RectificationStatus status = RectificationStatus::no_baseline;  ///< the other members are valid only if ok
  Camera camera;                                                  ///< both rectified cameras; fx = fy
  double baseline = 0;                                            ///< metres
  Eigen::Quaterniond rectified_from_left = Eigen::Quaterniond::Identity();
  Eigen::Quaterniond rectified_from_right = Eigen::Quaterniond::Identity();
};

/// Computes the rectification of a pair. The rotation about the baseline is free (Fusiello, Trucco, Verri
/// 2000, "A compact algorithm for rectification of stereo pairs", sec. 3); here z is as near as possible to
/// both optical axes, which distorts least. Focal length and centre are chosen such that both raw cameras see
/// every pixel, with the widest such view, as long as the middle of the images keeps at least 4/5 of its
/// resolution. The size is the left camera's, with width and height exchanged if the baseline is more
/// vertical than horizontal.
[[nodiscard]] StereoRectification rectify_stereo(const StereoPair& pair);

}  // namespace cairn
