// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cairn/dense/cloud.h"
#include "cairn/dense/surface.h"
#include "cairn/geometry/camera.h"
#include "cairn/geometry/rigid3.h"
#include "cairn/image/image.h"

namespace cairn {

/// From where a picture is taken: a camera without distortion and its pose.
struct RenderCamera {
  Camera camera;
  Rigid3 world_from_camera;
};

/// The way of the camera that made the cloud, drawn as a line from blue to orange.
struct CameraPath {
  std::vector<Rigid3> world_from_camera;
  std::vector<std::size_t> keyframes;  ///< positions in it, marked by small frustums
};

struct RenderOptions {
  double point_size = 0.01;   ///< metres: the cloud's voxel size, so that surfaces close
  int supersampling = 2;      ///< drawn so many times larger and averaged down: smooth edges
  double edge_strength = 35;  ///< how much an edge in depth darkens what lies behind it; 0: not at all
  Rgb8 background_top{250, 251, 252}, background_bottom{222, 227, 233};
};

/// A picture of the cloud: each point a disc of its size, the nearest wins; edges are shaded by depth
/// (eye-dome lighting, Boucheny 2009, chapter 4) so that structure can be read. With `surface`, what faces
/// away from the viewer is left out: a room seen from outside opens like a doll's house. Deterministic; one
/// thread.
[[nodiscard]] RgbImage render_cloud(const Cloud& cloud, const RenderCamera& view,
                                    const RenderOptions& options = {}, const CloudSurface* surface = nullptr,
                                    const CameraPath* path = nullptr);

}  // namespace cairn
