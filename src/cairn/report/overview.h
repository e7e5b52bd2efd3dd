// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cairn/dense/surface.h"
#include "cairn/report/render.h"

namespace cairn {

/// The direction that is up in the world, unit: the mean of the cameras' up, drawn to the normals of floors
/// and tables near it; z where there is no path.
[[nodiscard]] Eigen::Vector3d estimate_up(const CloudSurface& surface, const std::vector<Rigid3>& path);

/// A view of the whole cloud, obliquely from above, from the side that shows most of it. Assumes that the
/// picture is drawn with the surface (what faces away left out).
[[nodiscard]] RenderCamera overview_of(const CloudSurface& surface, const std::vector<Rigid3>& path,
                                       int width, int height);

/// An overview picture of a cloud with the path that made it: the above together, with keyframes marked.
/// `voxel_size` is the cloud's, metres.
[[nodiscard]] RgbImage draw_overview(const Cloud& cloud, const CameraPath& path, double voxel_size,
                                     int width = 1600, int height = 1000);

}  // namespace cairn
