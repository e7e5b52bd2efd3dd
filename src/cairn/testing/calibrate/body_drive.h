// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "cairn/calibrate/pose_fit.h"
#include "cairn/sequence/pose_path.h"
#include "cairn/sequence/trajectory.h"

namespace cairn::testkit {

/// Describes a drive of 20 s with a camera on a body, and what is wrong with what is stated of them.
struct BodyDrive {
  PoseTerms planted = PoseTerms::Zero();
  bool turns = true;       ///< else straight on at constant speed
  bool tilts = true;       ///< whether the body also rolls and pitches
  double angle_noise = 0;  ///< standard deviation of each frame's seen rotation, radians
  double place_noise = 0;  ///< and of its place, metres
  double given_noise = 0;  ///< of the place of each given pose, metres
  double duration_s = 20;
  std::uint64_t seed = 1;

  /// Returns the stated pose of the camera on the body (x forward, y left, z up).
  [[nodiscard]] static Rigid3 stated();
  /// Returns the body's poses, 100 a second, with the stamps that the time offset makes wrong.
  [[nodiscard]] GivenPath given() const;
  /// Returns what the images show, 10 frames a second, in a world of its own.
  [[nodiscard]] Trajectory visual() const;
};

}  // namespace cairn::testkit
