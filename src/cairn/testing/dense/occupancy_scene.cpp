// SPDX-License-Identifier: Apache-2.0
#include "cairn/testing/dense/occupancy_scene.h"

#include <octomap/OcTree.h>

#include <Eigen/Core>

#include "cairn/core/executor.h"
#include "cairn/testing/image/depth_scene.h"

namespace cairn::testkit {

namespace {

constexpr int kFrames = 10;

octomap::Pointcloud points_of(int frame) {
  const Camera camera = small_camera();
  const DepthImage depth = depth_image(static_cast<std::uint64_t>(frame));
  octomap::Pointcloud points;
  for (int v = 0; v < depth.height(); ++v) {
    for (int u = 0; u < depth.width(); ++u) {
      if (!(depth(u, v) > 0)) continue;
      const Eigen::Vector3d in_camera = *camera.back_project({u, v}, static_cast<double>(depth(u, v)));
      const Eigen::Vector3f point = (walking_pose(frame) * in_camera).cast<float>();
      points.push_back(point.x(), point.y(), point.z());
    }
  }
  return points;
}

}  // namespace

OccupancyGrid map_scene(int threads, bool colored) {
  const PixelRays rays(small_camera());
  OccupancyGrid grid;
  const Executor executor(threads);
  executor.ordered_pipeline<OccupancyUpdate>(
      kFrames,
      [&](std::size_t i) {
        return grid.scan(depth_image(i), colored ? color_image() : RgbImage(), rays,
                         walking_pose(static_cast<int>(i)));
      },
      [&](std::size_t, OccupancyUpdate&& update) {
        grid.apply(update);
        return true;
      });
  return grid;
}

std::unique_ptr<octomap::OcTree> map_scene_with_octomap() {
  auto tree = std::make_unique<octomap::OcTree>(0.05);
  for (int frame = 0; frame < kFrames; ++frame) {
    const Eigen::Vector3f origin = walking_pose(frame).translation.cast<float>();
    tree->insertPointCloud(points_of(frame), {origin.x(), origin.y(), origin.z()}, 4.0, false, true);
  }
  tree->expand();
  return tree;
}

}  // namespace cairn::testkit
