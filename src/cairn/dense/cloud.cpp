// SPDX-License-Identifier: Apache-2.0
#include "cairn/dense/cloud.h"

#include <fmt/format.h>

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

void visit(CloudOptions& options, ParameterVisitor& visitor) {
  visitor.parameter({"voxel_grid", above(0, "metres"), "Size of the voxels of the cloud, one point for each.",
                     "", "0.01 suits a room, 0.05 a building."},
                    options.voxel_size);
  visitor.parameter({"cloud.max_depth", above(0, "metres"), "A larger depth does not enter the cloud.", "",
                     "4 suits a Kinect."},
                    options.max_depth);
}

void CloudOptions::validate() const {
  check_ranges(*this);
  const Range depth = from(0, "metres"), step = from(0, "a share", "keeps all pixels");
  check_parameter(depth.contains(min_depth), "min_depth", depth.describe().c_str(), min_depth);
  check_parameter(step.contains(max_edge_step), "max_edge_step", step.describe().c_str(), max_edge_step);
  if (!(max_depth > min_depth)) {
    throw InputError({"cloud.max_depth", 0, fmt::format("a depth above {} m", min_depth),
                      fmt::format("{}", max_depth), "4 suits a Kinect."});
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
