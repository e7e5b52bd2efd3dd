// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "cairn/dense/cloud.h"
#include "cairn/geometry/rigid3.h"

namespace cairn {

/// Describes a piece of a cloud's surface, some centimetres wide.
struct SurfaceCell {
  Eigen::Vector3f centre = Eigen::Vector3f::Zero();  ///< mean of its points, metres
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< unit, towards the camera that saw it
  float flatness = 0;  ///< 1: a plane, 0: a ball (1 - smallest / middle eigenvalue of the covariance)
  bool seen = false;  ///< false if no pose of the path looked at it; the sign of the normal is then arbitrary
};

/// Computes normals of a cloud, for pictures of it: which way is up, what faces the viewer. They are computed
/// per cell of a coarse grid, from the points in the 27 cells around it; O(points).
class CloudSurface {
 public:
  /// Computes the surface. `path` holds the poses world_from_camera from which the cloud was seen; it may be
  /// empty. `cell_size` in metres.
  CloudSurface(const Cloud& cloud, const std::vector<Rigid3>& path, double cell_size);

  [[nodiscard]] double cell_size() const { return cell_size_; }
  [[nodiscard]] const std::vector<SurfaceCell>& cells() const { return cells_; }
  /// Returns the cell of the cloud's point i.
  [[nodiscard]] const SurfaceCell& cell_of_point(std::size_t i) const { return cells_[cell_of_point_[i]]; }

 private:
  double cell_size_;
  std::vector<SurfaceCell> cells_;
  std::vector<std::uint32_t> cell_of_point_;
};

}  // namespace cairn
