// SPDX-License-Identifier: Apache-2.0
#include "cairn/testing/optimize/bundle_scene.h"

#include <algorithm>
#include <numbers>
#include <utility>

#include "cairn/core/random.h"
#include "cairn/testing/geometry/camera_paths.h"
#include "cairn/testing/geometry/random_points.h"

namespace cairn::testkit {

namespace {

constexpr SimulatedCamera kCamera{{525, 525, 319.5, 239.5, 0.12}, 640, 480};

class Maker {
 public:
  Maker(std::uint64_t seed, const BundleSceneOptions& options) : random_(seed), options_(options) {}

  BundleScene make() {
    scene_.problem.rig = kCamera.rig;
    for (int i = 0; i < options_.cameras; ++i) add_camera(i);
    while (static_cast<int>(scene_.true_points.size()) < options_.points) add_point();
    return std::move(scene_);
  }

 private:
  void add_camera(int i) {
    const double turn = std::min(0.03, 2 * std::numbers::pi / options_.cameras);
    scene_.true_cameras.push_back(small_motion(random_, 0.02, 0.02) * on_circle(i, turn, 0.1));
    const bool fixed = i < options_.fixed;
    Vector6d xi;
    xi.head<3>() = normal_vector(random_, 0.01 * options_.start_error);
    xi.tail<3>() = normal_vector(random_, 0.03 * options_.start_error);
    scene_.problem.camera_from_world.push_back(fixed ? scene_.true_cameras.back()
                                                     : perturb_left(xi, scene_.true_cameras.back()));
    scene_.problem.camera_fixed.push_back(fixed ? 1 : 0);
  }

  /// Adds a point if two cameras in a row see it.
  void add_point() {
    const auto cameras = static_cast<std::uint32_t>(options_.cameras);
    const std::uint32_t home = random_.index(cameras);
    const std::uint32_t track = 2 + random_.index(static_cast<std::uint32_t>(options_.longest_track) - 1);
    const Eigen::Vector3d point =
        scene_.true_cameras[home].inverse() * kCamera.point_in_view(random_, 1.5, 8);
    std::vector<BundleObservation> seen;
    for (std::uint32_t k = 0; k < std::min(track, cameras); ++k) {
      const std::uint32_t camera = (home + k) % cameras;
      const Eigen::Vector3d in_camera = scene_.true_cameras[camera] * point;
      if (!is_in_front(in_camera) || !kCamera.shows(kCamera.rig.project(in_camera))) continue;
      seen.push_back({static_cast<std::int32_t>(camera), static_cast<std::int32_t>(scene_.true_points.size()),
                      noisy(kCamera.rig.project(in_camera))});
    }
    if (seen.size() < 2) return;
    scene_.problem.observations.insert(scene_.problem.observations.end(), seen.begin(), seen.end());
    scene_.true_points.push_back(point);
    scene_.problem.points_in_world.emplace_back(point + normal_vector(random_, 0.05 * options_.start_error));
  }

  Observation noisy(const Eigen::Vector3d& exact) {
    Observation seen = observe(random_, exact, {options_.sigma_px, options_.sigma_px, options_.noise});
    if (random_.uniform() < options_.outlier_share) seen.v += random_.uniform(1, 3) * options_.outlier_px;
    if (random_.uniform() >= options_.disparity_share) forget_disparity(seen);
    return seen;
  }

  Random random_;
  BundleSceneOptions options_;
  BundleScene scene_;
};

}  // namespace

BundleScene make_bundle_scene(std::uint64_t seed, const BundleSceneOptions& options) {
  return Maker(seed, options).make();
}

}  // namespace cairn::testkit
