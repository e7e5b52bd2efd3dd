// SPDX-License-Identifier: Apache-2.0
// What the tests of given poses share: a sequence of frames at stamps, without images.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "cairn/geometry/rigid3.h"
#include "cairn/sequence/sequence.h"

namespace cairn::testkit {

/// Returns a sequence with the frames `numbers` at `rate_hz`, as they were listed.
[[nodiscard]] Sequence sequence_of(const char* format, const std::vector<std::int64_t>& numbers,
                                   double rate_hz);

/// Returns body_from_camera of a camera that looks forward, above, right of and before the body's origin; the
/// body's axes are forward, right, down.
[[nodiscard]] Rigid3 forward_camera_on_frd();
/// Returns the same for a body whose axes are forward, left, up.
[[nodiscard]] Rigid3 forward_camera_on_flu();

/// Returns earth-centred coordinates, metres, of a geodetic position on WGS 84, by the closed formula.
[[nodiscard]] Eigen::Vector3d earth_centred(double latitude_deg, double longitude_deg, double height_m);

/// Returns the axes east, north, up of a position, in earth-centred axes, as columns.
[[nodiscard]] Eigen::Matrix3d earth_from_enu(double latitude_deg, double longitude_deg);

}  // namespace cairn::testkit
