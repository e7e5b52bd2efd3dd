// SPDX-License-Identifier: Apache-2.0
#include "cairn/dense/cloud.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "cairn/core/error.h"
#include "cairn/core/executor.h"
#include "cairn/dense/depth_edges.h"
#include "cairn/testing/image/depth_scene.h"

namespace cairn {
namespace {

using testkit::color_image;
using testkit::depth_image;
using testkit::walking_pose;

constexpr int kFrames = 12;

Cloud fuse(int threads) {
  const PixelRays rays(testkit::small_camera());
  CloudBuilder builder({.voxel_size = 0.02, .max_edge_step = 0});
  const Executor executor(threads);
  executor.ordered_pipeline<VoxelSums>(
      kFrames,
      [&](std::size_t i) {
        return builder.reduce(depth_image(i), color_image(), rays, walking_pose(static_cast<int>(i)));
      },
      [&](std::size_t, VoxelSums&& frame) {
        builder.add(frame);
        return true;
      });
  return builder.take();
}

/// The same by the plain definition: a map from voxel to sums of doubles.
struct PlainSum {
  Eigen::Vector3d position = Eigen::Vector3d::Zero(), color = Eigen::Vector3d::Zero();
  int count = 0;
};
std::map<std::array<int, 3>, PlainSum> fuse_plainly(double voxel_size) {
  const Camera camera = testkit::small_camera();
  std::map<std::array<int, 3>, PlainSum> voxels;
  for (int frame = 0; frame < kFrames; ++frame) {
    const DepthImage depth = depth_image(static_cast<std::uint64_t>(frame));
    const RgbImage color = color_image();
    for (int v = 0; v < depth.height(); ++v) {
      for (int u = 0; u < depth.width(); ++u) {
        if (!(depth(u, v) > 0.1F && depth(u, v) <= 4.0F)) continue;
        const Eigen::Vector3d point =
            walking_pose(frame) * *camera.back_project({u, v}, static_cast<double>(depth(u, v)));
        const Eigen::Array3i key = (point / voxel_size).array().floor().cast<int>();
        PlainSum& sum = voxels[{key.z(), key.y(), key.x()}];
        sum.position += point;
        sum.color += Eigen::Vector3d(color(u, v).r, color(u, v).g, color(u, v).b);
        ++sum.count;
      }
    }
  }
  return voxels;
}

TEST(CloudBuilder, OnePointPerVoxelAtTheCentroidWithTheMeanColour) {
  constexpr double kVoxel = 0.02;
  const Cloud cloud = fuse(1);
  auto plain = fuse_plainly(kVoxel);
  ASSERT_EQ(cloud.points.size(), plain.size());
  for (const CloudPoint& point : cloud.points) {
    const Eigen::Vector3d position = Eigen::Vector3f(point.x, point.y, point.z).cast<double>();
    const Eigen::Array3i key = (position / kVoxel).array().floor().cast<int>();
    const auto place = plain.find({key.z(), key.y(), key.x()});
    ASSERT_NE(place, plain.end());
    const PlainSum& sum = place->second;
    EXPECT_LT((position - sum.position / sum.count).norm(), 2e-5);  // fixed point of 1/1024 voxel
    EXPECT_LE(std::abs(point.r - sum.color.x() / sum.count), 0.5 + 1e-9);
    EXPECT_LE(std::abs(point.g - sum.color.y() / sum.count), 0.5 + 1e-9);
    EXPECT_EQ(point.b, 77);
  }
}

TEST(CloudBuilder, TheSameAtAnyNumberOfThreads) {
  const Cloud one = fuse(1);
  EXPECT_GT(one.points.size(), 1000U);
  EXPECT_EQ(fuse(2).points, one.points);
  EXPECT_EQ(fuse(4).points, one.points);
}

TEST(CloudBuilder, DepthsOutOfRangeAndPixelsWithoutARayAreLeftOut) {
  Camera camera = testkit::small_camera();
  const RgbImage color = color_image();
  DepthImage depth(64, 48);
  depth(1, 1) = 0.1F;
  depth(2, 2) = 4.001F;
  depth(3, 3) = std::numeric_limits<float>::quiet_NaN();
  depth(4, 4) = std::numeric_limits<float>::infinity();
  depth(5, 5) = 4.0F;
  CloudBuilder builder;
  builder.add(depth, color, PixelRays(camera), Rigid3{});
  EXPECT_EQ(builder.size(), 1U);
  const Cloud cloud = builder.take();
  EXPECT_EQ(cloud.points.at(0).r, 15);
  EXPECT_EQ(builder.size(), 0U);
}

TEST(CloudBuilder, PixelsAtAnEdgeInDepthAreLeftOut) {
  DepthImage depth(64, 48, 2.0F);
  for (int v = 0; v < 48; ++v)
    for (int u = 32; u < 64; ++u) depth(u, v) = 1.0F;
  for (int v = 0; v < 48; ++v) depth(10, v) = 0.0F;  // a hole is no edge
  const DepthImage kept = without_depth_edges(depth, 0.05);
  for (int u = 0; u < 64; ++u) EXPECT_EQ(kept(u, 20), u >= 30 && u < 34 ? 0.0F : depth(u, 20)) << u;
  EXPECT_EQ(without_depth_edges(depth, 1.5), depth);
  DepthImage rows(4, 12, 2.0F);
  for (int v = 6; v < 12; ++v)
    for (int u = 0; u < 4; ++u) rows(u, v) = 4.0F;
  const DepthImage kept_rows = without_depth_edges(rows, 0.05);
  for (int v = 0; v < 12; ++v) EXPECT_EQ(kept_rows(1, v), v >= 4 && v < 8 ? 0.0F : rows(1, v)) << v;
}

TEST(CloudBuilder, BoundsHoldAllPoints) {
  const Cloud cloud = {{{1, 2, 3, 0, 0, 0}, {-1, 5, 2, 0, 0, 0}}};
  const CloudBounds bounds = bounds_of(cloud);
  EXPECT_EQ(bounds.low, Eigen::Vector3f(-1, 2, 2));
  EXPECT_EQ(bounds.high, Eigen::Vector3f(1, 5, 3));
  EXPECT_EQ(bounds_of({}).high, Eigen::Vector3f(0, 0, 0));
}

TEST(CloudBuilder, RefusesOptionsThatMeanNothing) {
  EXPECT_THROW(CloudBuilder({.voxel_size = 0}), InputError);
  EXPECT_THROW(CloudBuilder({.voxel_size = std::nan("")}), InputError);
  EXPECT_THROW(CloudBuilder({.min_depth = -1}), InputError);
  try {
    CloudBuilder({.min_depth = 1, .max_depth = 0.5});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "cloud.max_depth: expected a depth above 1 m, found 0.5.\n  4 suits a Kinect.");
  }
}

TEST(CloudBuilder, RefusesPosesFarFromTheOrigin) {
  CloudBuilder builder;
  Rigid3 far;
  far.translation = {4e6, 0, 0};
  EXPECT_THROW(builder.add(depth_image(1), color_image(), PixelRays(testkit::small_camera()), far),
               InputError);
}

}  // namespace
}  // namespace cairn
