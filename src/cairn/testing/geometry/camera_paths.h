// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cairn/geometry/framed.h"
#include "cairn/geometry/rigid3.h"

namespace cairn::testkit {

/// Returns the pose of a camera that looks along z, moved to the right by `x` metres.
[[nodiscard]] Rigid3 aside(double x);

/// Returns the pose of a camera that looks along z, moved ahead by `z` metres.
[[nodiscard]] Rigid3 ahead(double z);

/// Returns world_from_camera `frame` metres along z, on a slight bend to the right.
[[nodiscard]] WorldFromCamera on_bend(int frame);

/// Returns camera_from_world number `i` of cameras that look outwards from a circle about the world's y axis,
/// `turn` radians and `step` metres from one to the next; camera 0 looks along z.
[[nodiscard]] Rigid3 on_circle(int i, double turn, double step);

/// Returns the length of the way from `a` to `b`, metres.
[[nodiscard]] double distance(const Rigid3& a, const Rigid3& b);

}  // namespace cairn::testkit
