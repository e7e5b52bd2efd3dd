// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <map>
#include <string>

#include "cairn/core/error.h"
#include "cairn/core/file.h"
#include "cairn/core/random.h"
#include "cairn/geometry/covariance.h"
#include "cairn/map/map.h"
#include "cairn/map/map_file.h"

namespace cairn {

constexpr Rig kSceneRig{525, 520, 319.5, 239.5, 0.075};

/// A folder that is gone after the test, of which it has the name.
class TestFolder {
 public:
  TestFolder() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    path_ = std::filesystem::path(testing::TempDir()) /
            (std::string(test->test_suite_name()) + test->name() + std::to_string(::getpid()));
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~TestFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TestFolder(const TestFolder&) = delete;
  TestFolder& operator=(const TestFolder&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Bytes by name of all files below a folder.
inline std::map<std::string, std::string> contents_of(const std::filesystem::path& folder) {
  std::map<std::string, std::string> contents;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      contents[entry.path().lexically_relative(folder).string()] = read_file(entry.path());
  return contents;
}

/// What read_map says, with MAP for the folder.
inline std::string message_for(const std::filesystem::path& folder) {
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

/// A frame whose feature i shows point i, each third without a disparity.
inline ObservedFrame observe_points(const std::vector<Eigen::Vector3d>& points_in_world,
                                    const Rigid3& world_from_camera, std::size_t descriptor_bytes,
                                    Random& random) {
  ObservedFrame frame;
  frame.features.descriptors = Descriptors(Norm::hamming, descriptor_bytes, points_in_world.size());
  for (std::size_t i = 0; i < points_in_world.size(); ++i) {
    const Eigen::Vector3d projected = kSceneRig.project(world_from_camera.inverse() * points_in_world[i]);
    const double sigma = 1.0 + static_cast<double>(i % 4);
    Observation seen{projected.x() + sigma * random.normal(), projected.y() + sigma * random.normal()};
    seen.sigma_px = sigma;
    seen.sigma_d_px = 0.3;
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

/// Five keyframes of two parts, the third erased; ten landmarks, two of them erased, seen by three keyframes
/// at most. Descriptors of 61 bytes, as AKAZE's, are no multiple of 8.
inline Map scene_map() {
  Random random(20250711);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 10; ++i) points.emplace_back(random.normal(), random.normal(), 4 + random.normal());
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
    map.add_sighting(id, {{3}, i});
    if (i % 2 == 0) map.add_sighting(id, {{4}, i});
  }
  map.erase(LandmarkId{0});
  map.erase(LandmarkId{7});
  map.erase(KeyframeId{2});
  return map;
}

/// Positive definite and different for each landmark, also for erased ones.
inline std::vector<Eigen::Matrix3d> scene_covariances(const Map& map) {
  std::vector<Eigen::Matrix3d> covariances;
  for (const Landmark& landmark : map.landmarks()) {
    const Eigen::Vector3d& axis = landmark.point_in_world;
    covariances.emplace_back(Eigen::Vector3d(0.01, 0.04, 0.09).asDiagonal());
    covariances.back() = as_covariance(covariances.back() + 0.01 * axis * axis.transpose());
  }
  return covariances;
}

}  // namespace cairn
