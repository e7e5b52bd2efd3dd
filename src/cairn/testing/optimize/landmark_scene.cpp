// SPDX-License-Identifier: Apache-2.0
#include "cairn/testing/optimize/landmark_scene.h"

#include <utility>

#include "cairn/core/random.h"
#include "cairn/testing/geometry/camera_paths.h"
#include "cairn/testing/geometry/random_points.h"

namespace cairn::testkit {

namespace {

class Maker {
 public:
  Maker(std::uint64_t seed, const LandmarkSceneOptions& options) : random_(seed), options_(options) {}

  LandmarkScene make() {
    const Rigid3 world_from_street{rotation_exp({0.3, -0.8, 1.1}), options_.place_in_world};
    for (int i = 0; i < kCameras; ++i) {
      const WorldFromCamera pose(world_from_street * ahead(i) * small_motion(random_, 0.02, 0.05));
      scene_.cameras.push_back(pose.inverse());
    }
    while (static_cast<int>(scene_.tracks.size()) < options_.landmarks) add_landmark();
    return std::move(scene_);
  }

 private:
  static constexpr int kCameras = 100;

  /// Adds a point that its last camera sees anywhere, so that those behind it see it nearer to the middle.
  void add_landmark() {
    const auto span = static_cast<std::uint32_t>(options_.longest_track - options_.shortest_track + 1);
    const int track = options_.shortest_track + static_cast<int>(random_.index(span));
    const int last =
        track - 1 + static_cast<int>(random_.index(static_cast<std::uint32_t>(kCameras - track + 1)));
    const SimulatedCamera camera{scene_.rig, 1241, 376};
    const Eigen::Vector3d in_last = camera.point_in_view(random_, options_.nearest, options_.farthest);
    scene_.points_in_world.push_back(scene_.cameras[static_cast<std::size_t>(last)].inverse() * in_last);
    scene_.tracks.emplace_back();
    scene_.wrong.emplace_back();
    for (int i = last - track + 1; i <= last; ++i) add_observation(i);
  }

  void add_observation(int camera) {
    const Eigen::Vector3d in_camera =
        scene_.cameras[static_cast<std::size_t>(camera)] * scene_.points_in_world.back();
    const double sigma = options_.noise_px > 0 ? options_.noise_px : 0.5;
    Observation seen =
        observe(random_, scene_.rig.project(in_camera), {sigma, sigma, options_.noise_px / sigma});
    if (random_.uniform() >= options_.disparity_share) forget_disparity(seen);
    const bool wrong = random_.uniform() < options_.outlier_share;
    if (wrong) mislead(random_, options_.outlier_px, seen);
    scene_.tracks.back().push_back({camera, seen});
    scene_.wrong.back().push_back(wrong ? 1 : 0);
  }

  Random random_;
  LandmarkSceneOptions options_;
  LandmarkScene scene_;
};

}  // namespace

LandmarkScene make_landmark_scene(std::uint64_t seed, const LandmarkSceneOptions& options) {
  return Maker(seed, options).make();
}

}  // namespace cairn::testkit
