// SPDX-License-Identifier: Apache-2.0
#include "cairn/testing/image/depth_scene.h"

#include "cairn/core/random.h"

namespace cairn::testkit {

Camera small_camera() {
  Camera camera;
  camera.width = 64;
  camera.height = 48;
  camera.fx = camera.fy = 52.5;
  camera.cx = 31.5;
  camera.cy = 23.5;
  return camera;
}

DepthImage depth_image(std::uint64_t seed) {
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

RgbImage color_image() {
  RgbImage color(64, 48);
  for (int v = 0; v < 48; ++v)
    for (int u = 0; u < 64; ++u)
      color(u, v) = {static_cast<std::uint8_t>(3 * u), static_cast<std::uint8_t>(5 * v), 77};
  return color;
}

Rigid3 walking_pose(int frame) {
  return {rotation_exp({0.02 * frame, 0.11 * frame, -0.01 * frame}),
          {0.013 + 0.07 * frame, -0.021 * frame, 0.4 - 0.05 * frame}};
}

}  // namespace cairn::testkit
