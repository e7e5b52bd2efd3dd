// SPDX-License-Identifier: Apache-2.0
// Simulated points, and one camera that sees them.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "cairn/core/random.h"
#include "cairn/geometry/camera_pose.h"
#include "cairn/testing/geometry/random_points.h"

namespace cairn::testkit {

inline constexpr SimulatedCamera kPoseCamera{{525, 525, 319.5, 239.5, 0.075}, 640, 480};
inline constexpr Rig kPoseRig = kPoseCamera.rig;

/// Holds points in the world and where one camera sees them, with its true pose.
struct PoseScene {
  CameraFromWorld camera_from_world;
  std::vector<Eigen::Vector3d> points;
  std::vector<Observation> seen;
  std::vector<Eigen::Matrix3d> covariances;  ///< empty: points are exact

  /// Returns views of the lists, which stay valid as long as the scene.
  [[nodiscard]] Correspondences correspondences() const { return {points, seen, covariances}; }
};

/// Describes a PoseScene.
struct PoseSceneOptions {
  int count = 60;
  double noise = 1;        ///< times the standard deviations that are stated
  bool stereo = false;     ///< two of three observations have a disparity
  bool uncertain = false;  ///< points are off by their covariances
  int outliers = 0;        ///< the first so many are 30 to 60 px aside
};

/// Returns a pose that is turned by a few radians and moved by a few metres.
[[nodiscard]] CameraFromWorld random_pose(Random& random);

/// Returns a noisy observation of `exact`, (u, v, d), whose u and v have standard deviations of 0.5 to 2 px.
[[nodiscard]] Observation noisy_observation(Random& random, const Eigen::Vector3d& exact, double noise,
                                            bool stereo);

/// Returns points in view at 2 to 8 m.
[[nodiscard]] PoseScene make_pose_scene(std::uint64_t seed, const PoseSceneOptions& options = {});

/// Returns `pose` turned by 2 degrees and moved by 4 cm, times `size`.
[[nodiscard]] CameraFromWorld nudged(const CameraFromWorld& pose, double size = 1);

/// Returns the left perturbation from the estimated pose to the true one.
[[nodiscard]] Vector6d error_of(const PoseEstimate& estimate, const PoseScene& scene);

}  // namespace cairn::testkit
