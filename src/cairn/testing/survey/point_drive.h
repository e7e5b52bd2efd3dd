// SPDX-License-Identifier: Apache-2.0
// What the tests of mapping share: a drive past points, without images.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "cairn/survey/landmarks.h"
#include "cairn/testing/geometry/camera_paths.h"

namespace cairn::testkit {

inline constexpr Rig kDriveRig{700, 700, 620, 190, 0.54};
inline constexpr std::uint64_t kDriveLooks = 77;  ///< seed of the descriptors, for put_look

/// Describes a point beside the road. Points of one look have one descriptor.
struct DrivePoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  std::uint64_t look = 0;
};

/// Returns points 20 to 45 m before pose 0, each with a look of its own. The first fifteen frames see all of
/// them.
[[nodiscard]] std::vector<DrivePoint> roadside_points(std::size_t count, std::uint64_t seed = 1);

/// Returns frame number `frame` from `pose`: its feature i shows point i, wherever that is, with a disparity.
/// `noise_px` is the standard deviation of u, v and d; 0.5 is stated.
[[nodiscard]] SurveyFrame see(const std::vector<DrivePoint>& points, int frame, const WorldFromCamera& pose,
                              double noise_px = 0);

/// Takes the disparity from a feature.
void forget_disparity(std::size_t feature, SurveyFrame& frame);

/// Returns the first frames of the drive, whose poses are those of on_bend.
[[nodiscard]] FrameBuffer drive(const std::vector<DrivePoint>& points, int count, double noise_px = 0);

/// Returns the observations of `feature` in frames `first` to `last`.
[[nodiscard]] std::vector<ObservationRef> observations_of(std::int32_t feature, int first, int last);

/// Returns a track of these observations.
[[nodiscard]] Track track_of(const FrameBuffer& frames, std::int32_t feature, int first, int last);

}  // namespace cairn::testkit
