// SPDX-License-Identifier: Apache-2.0
#include "cairn/testing/geometry/pose_scene.h"

namespace cairn::testkit {

CameraFromWorld random_pose(Random& random) {
  return CameraFromWorld(small_motion(random, 1, 1));
}

Observation noisy_observation(Random& random, const Eigen::Vector3d& exact, double noise, bool stereo) {
  const double sigma_px = random.uniform(0.5, 2.0);
  return observe(random, exact, {sigma_px, 0.3, noise}, stereo);
}

PoseScene make_pose_scene(std::uint64_t seed, const PoseSceneOptions& options) {
  Random random(seed);
  PoseScene scene;
  scene.camera_from_world = random_pose(random);
  const Rigid3 world_from_camera = scene.camera_from_world.inverse();
  for (int i = 0; i < options.count; ++i) {
    const Eigen::Vector3d in_camera = kPoseCamera.point_in_view(random, 2, 8);
    Observation seen =
        noisy_observation(random, kPoseRig.project(in_camera), options.noise, options.stereo && i % 3 != 0);
    if (i < options.outliers) seen.u += random.uniform(30, 60);
    Eigen::Vector3d point = world_from_camera * in_camera;
    if (options.uncertain) {
      const Eigen::Vector3d sigma = random.uniform(0.002, 0.03) * Eigen::Vector3d(1, 1.4, 0.7);
      scene.covariances.emplace_back(sigma.cwiseAbs2().asDiagonal());
      point += sigma.cwiseProduct(normal_vector(random));
    }
    scene.points.push_back(point);
    scene.seen.push_back(seen);
  }
  return scene;
}

CameraFromWorld nudged(const CameraFromWorld& pose, double size) {
  Vector6d xi;
  xi << 0.02, -0.03, 0.01, 0.03, 0.02, -0.02;
  return perturb_left(size * xi, pose);
}

Vector6d error_of(const PoseEstimate& estimate, const PoseScene& scene) {
  return left_perturbation(estimate.camera_from_world, scene.camera_from_world);
}

}  // namespace cairn::testkit
