// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cairn/core/random.h"
#include "cairn/optimize/bundle_adjustment.h"

namespace cairn {

struct BundleSceneOptions {
  int cameras = 8;
  int fixed = 2;  ///< the first ones
  int points = 100;
  int longest_track = 6;       ///< cameras in a row that may see a point; each from 2 to this many
  double disparity_share = 1;  ///< of the observations
  double outlier_share = 0;    ///< of the observations
  double outlier_px = 20;      ///< their rows are one to three times this aside
  double sigma_px = 0.7;       ///< of u, v and d, as stated to the solver
  double noise = 1;            ///< standard deviations of the pixels
  double start_error = 1;      ///< times 0.01 rad and 3 cm of the free cameras, 5 cm of the points
};

/// Simulated cameras with the truth.
struct BundleScene {
  BundleProblem problem;
  std::vector<Rigid3> true_cameras;
  std::vector<Eigen::Vector3d> true_points;
};

/// Cameras a tenth of a metre apart on an arc, or a circle where there are enough of them, that look outwards
/// at points 1.5 to 8 m away.
class BundleSceneMaker {
 public:
  BundleSceneMaker(std::uint64_t seed, const BundleSceneOptions& options)
      : random_(seed), options_(options) {}

  BundleScene make() {
    scene_.problem.rig = {525, 525, 319.5, 239.5, 0.12};
    for (int i = 0; i < options_.cameras; ++i) add_camera(i);
    while (static_cast<int>(scene_.true_points.size()) < options_.points) add_point();
    return std::move(scene_);
  }

 private:
  Eigen::Vector3d noise(double size) {
    return size * Eigen::Vector3d(random_.normal(), random_.normal(), random_.normal());
  }

  void add_camera(int i) {
    const double turn = std::min(0.03, 2 * std::numbers::pi / options_.cameras), radius = 0.1 / turn;
    const Rigid3 outwards{rotation_exp({0, -turn * i, 0}), {0, 0, -radius}};
    scene_.true_cameras.push_back(Rigid3{rotation_exp(noise(0.02)), noise(0.02)} * outwards);
    const bool fixed = i < options_.fixed;
    Vector6d xi;
    xi << noise(0.01 * options_.start_error), noise(0.03 * options_.start_error);
    scene_.problem.camera_from_world.push_back(fixed ? scene_.true_cameras.back()
                                                     : perturb_left(xi, scene_.true_cameras.back()));
    scene_.problem.camera_fixed.push_back(fixed ? 1 : 0);
  }

  void add_point() {
    const Rig& rig = scene_.problem.rig;
    const auto cameras = static_cast<std::uint32_t>(options_.cameras);
    const std::uint32_t home = random_.index(cameras);
    const std::uint32_t track = 2 + random_.index(static_cast<std::uint32_t>(options_.longest_track) - 1);
    const Eigen::Vector3d in_camera =
        rig.point_at(random_.uniform(0, 639), random_.uniform(0, 479), random_.uniform(1.5, 8));
    const Eigen::Vector3d point = scene_.true_cameras[home].inverse() * in_camera;
    std::vector<BundleObservation> seen;
    for (std::uint32_t k = 0; k < std::min(track, cameras); ++k) {
      const std::uint32_t camera = (home + k) % cameras;
      const Eigen::Vector3d exact = rig.project(scene_.true_cameras[camera] * point);
      if (!is_in_front(scene_.true_cameras[camera] * point) || exact.x() < 0 || exact.x() > 639 ||
          exact.y() < 0 || exact.y() > 479)
        continue;
      seen.push_back({static_cast<std::int32_t>(camera), static_cast<std::int32_t>(scene_.true_points.size()),
                      observe(exact)});
    }
    if (seen.size() < 2) return;
    scene_.problem.observations.insert(scene_.problem.observations.end(), seen.begin(), seen.end());
    scene_.true_points.push_back(point);
    scene_.problem.points_in_world.emplace_back(point + noise(0.05 * options_.start_error));
  }

  Observation observe(const Eigen::Vector3d& exact) {
    const Eigen::Vector3d pixels = exact + noise(options_.noise * options_.sigma_px);
    Observation seen{
        .u = pixels.x(), .v = pixels.y(), .sigma_px = options_.sigma_px, .sigma_d_px = options_.sigma_px};
    if (random_.uniform() < options_.outlier_share) seen.v += random_.uniform(1, 3) * options_.outlier_px;
    if (random_.uniform() < options_.disparity_share) seen.d = pixels.z();
    return seen;
  }

  Random random_;
  BundleSceneOptions options_;
  BundleScene scene_;
};

inline BundleScene make_bundle_scene(std::uint64_t seed, const BundleSceneOptions& options = {}) {
  return BundleSceneMaker(seed, options).make();
}

}  // namespace cairn
