// SPDX-License-Identifier: Apache-2.0
#include "cairn/dense/cloud.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "cairn/core/error.h"
#include "cairn/dense/depth_edges.h"

namespace cairn {

CloudBounds bounds_of(const Cloud& cloud) {
  if (cloud.points.empty()) return {};
  const auto position = [](const CloudPoint& p) { return Eigen::Vector3f(p.x, p.y, p.z); };
  CloudBounds bounds{position(cloud.points[0]), position(cloud.points[0])};
  for (const CloudPoint& point : cloud.points) {
    bounds.low = bounds.low.cwiseMin(position(point));
    bounds.high = bounds.high.cwiseMax(position(point));
  }
  return bounds;
}

void CloudOptions::validate() const {
  if (!(voxel_size > 0) || !std::isfinite(voxel_size)) {
    throw InputError({"voxel_grid", 0, "a voxel size above 0 m", fmt::format("{}", voxel_size),
                      "0.01 suits a room, 0.05 a building."});
  }
  if (!(min_depth >= 0)) {
    throw InputError({"min_depth", 0, "a depth of 0 m or more", fmt::format("{}", min_depth),
                      "Leave it out for the default."});
  }
  if (!(max_depth > min_depth) || !std::isfinite(max_depth)) {
    throw InputError({"max_depth", 0, fmt::format("a depth above {} m", min_depth),
                      fmt::format("{}", max_depth), "4 suits a Kinect."});
  }
  if (!(max_edge_step >= 0)) {
    throw InputError({"max_edge_step", 0, "a share of 0 or more", fmt::format("{}", max_edge_step),
                      "0 keeps all pixels, 0.05 leaves out those at edges in depth."});
  }
}

CloudBuilder::CloudBuilder(const CloudOptions& options)
    : options_((options.validate(), options)), sums_(options.voxel_size) {}

VoxelSums CloudBuilder::reduce(const DepthImage& depth, const RgbImage& color, const PixelRays& rays,
                               const Rigid3& world_from_camera) const {
  require(!color.empty(), "a coloured cloud needs colour images");
  VoxelSums frame(options_.voxel_size);
  const auto add = [&](const DepthImage& kept) {
    frame.add_image(kept, color, rays, world_from_camera, options_.min_depth, options_.max_depth);
  };
  options_.max_edge_step > 0 ? add(without_depth_edges(depth, options_.max_edge_step)) : add(depth);
  return frame;
}

Cloud CloudBuilder::take() {
  const VoxelSums sums = std::exchange(sums_, VoxelSums(options_.voxel_size));
  Cloud cloud;
  cloud.points.reserve(sums.size());
  sums.visit_sorted([&](const VoxelKey& key, const VoxelSum& sum) {
    const Eigen::Vector3f mean = sums.mean(key, sum).cast<float>();
    const Rgb8 color = mean_color(sum);
    cloud.points.push_back({mean.x(), mean.y(), mean.z(), color.r, color.g, color.b});
  });
  return cloud;
}

}  // namespace cairn
