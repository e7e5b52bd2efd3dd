// SPDX-License-Identifier: Apache-2.0
#include "cairn/testing/map_files/scene_map.h"

#include <cstdint>
#include <utility>

#include "cairn/core/error.h"
#include "cairn/geometry/covariance.h"
#include "cairn/map_files/map_file.h"
#include "cairn/testing/geometry/random_points.h"

namespace cairn::testkit {

std::string message_for(const std::filesystem::path& folder) {
  try {
    (void)read_map(folder);
  } catch (const InputError& error) {
    std::string message = error.what();
    const std::string path = folder.string();
    if (const auto place = message.find(path); place != std::string::npos)
      message.replace(place, path.size(), "MAP");
    return message;
  }
  return "no error";
}

ObservedFrame observe_points(const std::vector<Eigen::Vector3d>& points_in_world,
                             const Rigid3& world_from_camera, std::size_t descriptor_bytes, Random& random) {
  ObservedFrame frame;
  frame.features.descriptors = Descriptors(Norm::hamming, descriptor_bytes, points_in_world.size());
  for (std::size_t i = 0; i < points_in_world.size(); ++i) {
    const Eigen::Vector3d projected = kSceneRig.project(world_from_camera.inverse() * points_in_world[i]);
    const double sigma = 1.0 + static_cast<double>(i % 4);
    Observation seen = observe(random, projected, {sigma, 0.3}, false);
    if (i % 3 != 0) seen.d = projected.z();
    frame.observations.push_back(seen);
    frame.points_in_camera.push_back(point_in_camera(kSceneRig, seen));
    frame.features.keypoints.push_back(
        {static_cast<float>(seen.u), static_cast<float>(seen.v), 31, 12.5F, 0, static_cast<float>(sigma)});
    for (std::size_t b = 0; b < descriptor_bytes; ++b)
      frame.features.descriptors.row(i)[b] = static_cast<std::uint8_t>(random.index(256));
  }
  return frame;
}

Map scene_map() {
  Random random(20250711);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 10; ++i) points.emplace_back(Eigen::Vector3d(0, 0, 4) + normal_vector(random));
  Map map(kSceneRig, "AKAZE");
  for (int k = 0; k < 5; ++k) {
    const Rigid3 pose{rotation_exp(0.1 * k * Eigen::Vector3d(0.3, 1, -0.2)),
                      {0.1 * k, 0.03 * k, 1.0 / 3.0 * k}};
    ObservedFrame frame = observe_points(points, pose, 61, random);
    frame.frame = {10 * k};
    frame.stamp_ns = 1'305'031'453'359'684'000 + 100'000'001 * k;
    map.add_keyframe(std::move(frame), pose, k == 0 || k == 3 ? KeyframeId{} : KeyframeId{k - 1},
                     k < 3 ? 0 : 1);
  }
  for (std::int32_t i = 0; i < 10; ++i) {
    const LandmarkId id = map.add_landmark(points[static_cast<std::size_t>(i)], {{i % 3}, i});
    map.add_observation(id, {{3}, i});
    if (i % 2 == 0) map.add_observation(id, {{4}, i});
  }
  map.erase(LandmarkId{0});
  map.erase(LandmarkId{7});
  map.erase(KeyframeId{2});
  return map;
}

std::vector<Eigen::Matrix3d> scene_covariances(const Map& map) {
  std::vector<Eigen::Matrix3d> covariances;
  for (const Landmark& landmark : map.landmarks()) {
    const Eigen::Vector3d& axis = landmark.point_in_world;
    covariances.emplace_back(Eigen::Vector3d(0.01, 0.04, 0.09).asDiagonal());
    covariances.back() = as_covariance(covariances.back() + 0.01 * axis * axis.transpose());
  }
  return covariances;
}

}  // namespace cairn::testkit
