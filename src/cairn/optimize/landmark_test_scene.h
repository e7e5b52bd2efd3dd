// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <vector>

#include "cairn/core/random.h"
#include "cairn/optimize/landmark_fit.h"

namespace cairn {

struct LandmarkSceneOptions {
  int landmarks = 200;
  int shortest_track = 3;  ///< sightings of a landmark, from this many
  int longest_track = 20;  ///< to this many
  double nearest = 6;      ///< depth in the last camera that sees it, metres, from here
  double farthest = 30;    ///< to here
  double noise_px = 0.5;   ///< of u, v and d, as stated to the solver
  double disparity_share = 1;
  double outlier_share = 0;                                  ///< of the sightings
  double outlier_px = 30;                                    ///< they are one to three times this aside
  Eigen::Vector3d place_in_world = Eigen::Vector3d::Zero();  ///< where the drive begins, metres
};

/// A drive along a street with the truth: a stereo camera a metre further on with each frame.
struct LandmarkScene {
  Rig rig{718.856, 718.856, 607.19, 185.22, 0.537};
  std::vector<CameraFromWorld> cameras;
  std::vector<Eigen::Vector3d> points_in_world;
  std::vector<std::vector<LandmarkSighting>> tracks;  ///< one for each point
  std::vector<std::vector<char>> wrong;               ///< one for each sighting
};

class LandmarkSceneMaker {
 public:
  LandmarkSceneMaker(std::uint64_t seed, const LandmarkSceneOptions& options)
      : random_(seed), options_(options) {}

  LandmarkScene make() {
    const Eigen::Quaterniond street = rotation_exp({0.3, -0.8, 1.1});
    for (int i = 0; i < kCameras; ++i) {
      const Rigid3 world_from_camera{
          street * rotation_exp(normal(0.02)),
          options_.place_in_world + street * (Eigen::Vector3d(0, 0, i) + normal(0.05))};
      scene_.cameras.push_back(WorldFromCamera(world_from_camera).inverse());
    }
    while (static_cast<int>(scene_.tracks.size()) < options_.landmarks) add_landmark();
    return std::move(scene_);
  }

 private:
  static constexpr int kCameras = 100;
  static constexpr double kWidth = 1241, kHeight = 376;

  Eigen::Vector3d normal(double size) {
    return size * Eigen::Vector3d(random_.normal(), random_.normal(), random_.normal());
  }

  /// Seen by its last camera anywhere, so that those behind it see it nearer to the middle.
  void add_landmark() {
    const auto span = static_cast<std::uint32_t>(options_.longest_track - options_.shortest_track + 1);
    const int track = options_.shortest_track + static_cast<int>(random_.index(span));
    const int last =
        track - 1 + static_cast<int>(random_.index(static_cast<std::uint32_t>(kCameras - track + 1)));
    const Eigen::Vector3d in_last =
        scene_.rig.point_at(random_.uniform(0, kWidth - 1), random_.uniform(0, kHeight - 1),
                            random_.uniform(options_.nearest, options_.farthest));
    scene_.points_in_world.push_back(scene_.cameras[static_cast<std::size_t>(last)].inverse() * in_last);
    scene_.tracks.emplace_back();
    scene_.wrong.emplace_back();
    for (int camera = last - track + 1; camera <= last; ++camera) add_sighting(camera);
  }

  void add_sighting(int camera) {
    const Eigen::Vector3d in_camera =
        scene_.cameras[static_cast<std::size_t>(camera)] * scene_.points_in_world.back();
    const Eigen::Vector3d pixels = scene_.rig.project(in_camera) + normal(options_.noise_px);
    const double sigma = options_.noise_px > 0 ? options_.noise_px : 0.5;
    Observation seen{.u = pixels.x(), .v = pixels.y(), .sigma_px = sigma, .sigma_d_px = sigma};
    if (random_.uniform() < options_.disparity_share) seen.d = pixels.z();
    const bool wrong = random_.uniform() < options_.outlier_share;
    if (wrong) mislead(seen);
    scene_.tracks.back().push_back({camera, seen});
    scene_.wrong.back().push_back(wrong ? 1 : 0);
  }

  /// As a wrong match does: elsewhere, at another disparity.
  void mislead(Observation& seen) {
    const double angle = random_.uniform(0, 6.283), aside = options_.outlier_px * random_.uniform(1, 3);
    seen.u += aside * std::cos(angle);
    seen.v += aside * std::sin(angle);
    if (seen.has_disparity()) seen.d = random_.uniform(1, 60);
  }

  Random random_;
  LandmarkSceneOptions options_;
  LandmarkScene scene_;
};

inline LandmarkScene make_landmark_scene(std::uint64_t seed, const LandmarkSceneOptions& options = {}) {
  return LandmarkSceneMaker(seed, options).make();
}

}  // namespace cairn
