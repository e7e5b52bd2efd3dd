// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "cairn/optimize/landmark_fit.h"

namespace cairn::testkit {

/// Describes a LandmarkScene.
struct LandmarkSceneOptions {
  int landmarks = 200;
  int shortest_track = 3;  ///< observations of a landmark, from this many
  int longest_track = 20;  ///< to this many
  double nearest = 6;      ///< depth in the last camera that sees it, metres, from here
  double farthest = 30;    ///< to here
  double noise_px = 0.5;   ///< of u, v and d, as stated to the solver
  double disparity_share = 1;
  double outlier_share = 0;                                  ///< of the observations
  double outlier_px = 30;                                    ///< they are one to three times this aside
  Eigen::Vector3d place_in_world = Eigen::Vector3d::Zero();  ///< where the drive begins, metres
};

/// Holds a drive along a street with the truth: a stereo camera a metre further on with each frame.
struct LandmarkScene {
  Rig rig{718.856, 718.856, 607.19, 185.22, 0.537};
  std::vector<CameraFromWorld> cameras;
  std::vector<Eigen::Vector3d> points_in_world;
  std::vector<std::vector<CameraObservation>> tracks;  ///< one for each point
  std::vector<std::vector<char>> wrong;                ///< one for each observation
};

/// Returns a drive past 100 cameras' poses, in a direction that is no axis of the world's.
[[nodiscard]] LandmarkScene make_landmark_scene(std::uint64_t seed, const LandmarkSceneOptions& options = {});

}  // namespace cairn::testkit
