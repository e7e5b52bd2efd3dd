// SPDX-License-Identifier: Apache-2.0
// Simulated points, and one camera that sees them.
#pragma once

#include <cmath>
#include <vector>

#include "cairn/core/random.h"
#include "cairn/geometry/camera_pose.h"

namespace cairn {

constexpr Rig kPoseRig{525, 525, 319.5, 239.5, 0.075};

struct PoseScene {
  CameraFromWorld camera_from_world;
  std::vector<Eigen::Vector3d> points;
  std::vector<Observation> seen;
  std::vector<Eigen::Matrix3d> covariances;  ///< empty: points are exact

  [[nodiscard]] Correspondences correspondences() const { return {points, seen, covariances}; }
};

struct PoseSceneOptions {
  int count = 60;
  double noise = 1;        ///< times the standard deviations that are stated
  bool stereo = false;     ///< two of three observations have a disparity
  bool uncertain = false;  ///< points are off by their covariances
  int outliers = 0;        ///< the first so many are 30 to 60 px aside
};

inline CameraFromWorld random_pose(Random& random) {
  return CameraFromWorld({rotation_exp({random.normal(), random.normal(), random.normal()}),
                          {random.normal(), random.normal(), random.normal()}});
}

inline Observation noisy_observation(Random& random, const Eigen::Vector3d& exact, double noise,
                                     bool stereo) {
  Observation seen;
  seen.sigma_px = random.uniform(0.5, 2.0);
  seen.sigma_d_px = 0.3;
  seen.u = exact.x() + noise * seen.sigma_px * random.normal();
  seen.v = exact.y() + noise * seen.sigma_px * random.normal();
  if (stereo) seen.d = exact.z() + noise * seen.sigma_d_px * random.normal();
  return seen;
}

/// Points in view at 2 to 8 m.
inline PoseScene make_pose_scene(std::uint64_t seed, const PoseSceneOptions& options = {}) {
  Random random(seed);
  PoseScene scene;
  scene.camera_from_world = random_pose(random);
  const Rigid3 world_from_camera = scene.camera_from_world.inverse();
  for (int i = 0; i < options.count; ++i) {
    const Eigen::Vector3d in_camera =
        kPoseRig.point_at(random.uniform(0, 639), random.uniform(0, 479), random.uniform(2, 8));
    Observation seen =
        noisy_observation(random, kPoseRig.project(in_camera), options.noise, options.stereo && i % 3 != 0);
    if (i < options.outliers) seen.u += random.uniform(30, 60);
    Eigen::Vector3d point = world_from_camera * in_camera;
    if (options.uncertain) {
      const Eigen::Vector3d sigma = random.uniform(0.002, 0.03) * Eigen::Vector3d(1, 1.4, 0.7);
      scene.covariances.emplace_back(sigma.cwiseAbs2().asDiagonal());
      point += sigma.cwiseProduct(Eigen::Vector3d(random.normal(), random.normal(), random.normal()));
    }
    scene.points.push_back(point);
    scene.seen.push_back(seen);
  }
  return scene;
}

/// `pose` turned by 2 degrees and moved by 4 cm, times `size`.
inline CameraFromWorld nudged(const CameraFromWorld& pose, double size = 1) {
  Vector6d xi;
  xi << 0.02, -0.03, 0.01, 0.03, 0.02, -0.02;
  return perturb_left(size * xi, pose);
}

inline Vector6d error_of(const PoseEstimate& estimate, const PoseScene& scene) {
  return left_perturbation(estimate.camera_from_world, scene.camera_from_world);
}

}  // namespace cairn
