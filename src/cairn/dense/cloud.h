// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "cairn/core/parameter.h"
#include "cairn/dense/voxel_sums.h"

namespace cairn {

/// Holds a point in the world, metres, with its colour.
struct CloudPoint {
  float x = 0, y = 0, z = 0;
  std::uint8_t r = 0, g = 0, b = 0;
  bool operator==(const CloudPoint&) const = default;
};

/// Holds the points of a cloud.
struct Cloud {
  std::vector<CloudPoint> points;
  bool colored = true;  ///< false if the colours have no meaning (a file without them)
};

/// Holds the corners of the box around all points, metres. Both are zero for an empty cloud.
struct CloudBounds {
  Eigen::Vector3f low = Eigen::Vector3f::Zero(), high = Eigen::Vector3f::Zero();
};
/// Computes the box around all points.
[[nodiscard]] CloudBounds bounds_of(const Cloud& cloud);

/// Sets which depths enter a cloud and how it is thinned.
struct CloudOptions {
  double voxel_size = 0.01;  ///< metres: about a Kinect's depth noise at 2 m, so no detail is lost below it
  double min_depth = 0.1;    ///< metres along the optical axis; a smaller depth is a faulty reading
  double max_depth = 4.0;    ///< metres; beyond, an RGB-D camera's noise (2.5 to 4 cm) blurs the cloud

  /// Share by which depths two pixels apart may differ; beyond, both are left out, because they mix
  /// foreground and background. A plane seen at 80 degrees stays (0.02); 0 keeps all.
  double max_edge_step = 0.05;

  /// Throws InputError that names the parameter or field if a voxel is not above 0, a depth is negative, the
  /// depths are reversed, or the step is negative.
  void validate() const;
};

/// Visits voxel_grid and cloud.max_depth; only the program sets the other fields.
void visit(CloudOptions& options, ParameterVisitor& visitor);

/// Fuses frames into one point per voxel: the centroid of all points that fall into it, with their mean
/// colour. The result depends neither on the order of the frames nor on threads: sums are integers.
///
/// With one thread, call add(depth, color, rays, pose) for each frame. With several, reduce() frames in
/// parallel (it is const and safe to call from several threads) and add() the reduced ones from one thread.
class CloudBuilder {
 public:
  explicit CloudBuilder(const CloudOptions& options = {});

  /// Reduces one frame to one point per voxel. Takes about 5 ms for 640x480. Throws PreconditionError if
  /// `color` is empty.
  [[nodiscard]] VoxelSums reduce(const DepthImage& depth, const RgbImage& color, const PixelRays& rays,
                                 const Rigid3& world_from_camera) const;
  void add(const VoxelSums& frame) { sums_.add(frame); }
  void add(const DepthImage& depth, const RgbImage& color, const PixelRays& rays,
           const Rigid3& world_from_camera) {
    add(reduce(depth, color, rays, world_from_camera));
  }

  [[nodiscard]] std::size_t size() const { return sums_.size(); }  ///< points so far
  /// Returns the cloud in order of the voxels; the builder is empty afterwards.
  [[nodiscard]] Cloud take();

 private:
  CloudOptions options_;
  VoxelSums sums_;
};

}  // namespace cairn
