// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <unistd.h>

#include <filesystem>
#include <string>

#include "cairn/core/random.h"
#include "cairn/geometry/camera.h"
#include "cairn/geometry/rigid3.h"
#include "cairn/image/image.h"

/// What several of this room's tests look at. Not part of the library.
namespace cairn::test_scene {

inline Camera small_camera() {
  Camera camera;
  camera.width = 64;
  camera.height = 48;
  camera.fx = camera.fy = 52.5;
  camera.cx = 31.5;
  camera.cy = 23.5;
  return camera;
}

/// A wall 2 m ahead with a box before it, holes, and a far corner beyond 4 m; with noise.
inline DepthImage depth_image(std::uint64_t seed) {
  Random random(seed);
  DepthImage depth(64, 48);
  for (int v = 0; v < 48; ++v) {
    for (int u = 0; u < 64; ++u) {
      double metres = 2.0 + 0.01 * u;
      if (u > 20 && u < 35 && v > 15) metres = 1.1;
      if (u > 50) metres = 5.3;
      if (v < 4) metres = 0;
      depth(u, v) = metres > 0 ? static_cast<float>(metres + 0.004 * random.normal()) : 0.0F;
    }
  }
  return depth;
}

inline RgbImage color_image() {
  RgbImage color(64, 48);
  for (int v = 0; v < 48; ++v)
    for (int u = 0; u < 64; ++u)
      color(u, v) = {static_cast<std::uint8_t>(3 * u), static_cast<std::uint8_t>(5 * v), 77};
  return color;
}

/// Poses of a camera that turns and walks.
inline Rigid3 world_from_camera(int frame) {
  return {rotation_exp({0.02 * frame, 0.11 * frame, -0.01 * frame}),
          {0.013 + 0.07 * frame, -0.021 * frame, 0.4 - 0.05 * frame}};
}

/// A path in a folder of this process.
inline std::filesystem::path temporary_path(const std::string& name) {
  const auto folder = std::filesystem::temp_directory_path() / ("cairn_dense_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  return folder / name;
}

}  // namespace cairn::test_scene
