// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "cairn/geometry/camera.h"
#include "cairn/geometry/rigid3.h"
#include "cairn/image/image.h"
#include "cairn/simulate/texture.h"

namespace cairn {

/// Describes a rectangle in space, seen from the side to which right x down points away from the viewer: for
/// a viewer in front of it, `right` is to the right, `down` is down and the texture reads as it was painted.
struct Surface {
  Eigen::Vector3d corner;  ///< top left, metres
  Eigen::Vector3d right;   ///< unit
  Eigen::Vector3d down;    ///< unit, at a right angle to `right`
  double width = 0;        ///< metres along `right`
  double height = 0;       ///< metres along `down`
  int texture = 0;         ///< index into Scene::textures
};

/// Holds textured rectangles and the colour that is seen between them.
struct Scene {
  std::vector<Surface> surfaces;
  std::vector<Texture> textures;
  Color background{200, 205, 215};
};

/// Holds what a pinhole camera without distortion sees: light before the sensor's gain and noise, and the
/// exact depth along the optical axis, metres, 0 if nothing is hit.
struct SceneImage {
  Image<Color> light;
  DepthImage depth;
};

/// Renders a scene: casts one ray through the centre of each pixel, exactly; where surfaces meet, the light
/// is the mean of four rays in the pixel. Textures are filtered over the pixel's footprint. Uses one thread
/// and is safe to call from several: parallelism is over frames.
[[nodiscard]] SceneImage render_scene(const Scene& scene, const Camera& camera,
                                      const Rigid3& scene_from_camera);

}  // namespace cairn
