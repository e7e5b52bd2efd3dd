// SPDX-License-Identifier: Apache-2.0
#include "cairn/dense/voxel_sums.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "cairn/core/error.h"
#include "cairn/core/random.h"
#include "cairn/testing/geometry/random_points.h"
#include "cairn/testing/image/depth_scene.h"

namespace cairn {
namespace {

struct Voxel {
  VoxelKey key;
  std::uint32_t count = 0;
  Eigen::Vector3d mean;
  Rgb8 color;
};

std::vector<Voxel> voxels_of(const VoxelSums& sums) {
  std::vector<Voxel> voxels;
  sums.visit_sorted([&](const VoxelKey& key, const VoxelSum& sum) {
    voxels.push_back({key, sum.count, sums.mean(key, sum), mean_color(sum)});
  });
  return voxels;
}

TEST(VoxelSums, a_voxel_has_the_mean_of_its_points) {
  VoxelSums sums(0.1);
  sums.add_point({0.02, 0.03, -0.02}, {10, 0, 255});
  sums.add_point({0.08, 0.01, -0.06}, {21, 0, 255});
  sums.add_point({0.12, 0.01, -0.06}, {1, 2, 3});
  EXPECT_EQ(sums.size(), 2U);
  const std::vector<Voxel> voxels = voxels_of(sums);
  ASSERT_EQ(voxels.size(), 2U);
  EXPECT_EQ(voxels[0].count, 2U);
  EXPECT_LT((voxels[0].mean - Eigen::Vector3d(0.05, 0.02, -0.04)).cwiseAbs().maxCoeff(), 0.1 / 1024);
  EXPECT_EQ(voxels[0].color, (Rgb8{16, 0, 255}));
  EXPECT_EQ(voxels[1].count, 1U);
}

TEST(VoxelSums, the_order_of_adding_means_nothing) {
  Random random(6);
  const auto points = testkit::points_in_box(random, 3000, {-1, -1, -1}, {1, 1, 1});
  VoxelSums forward(0.2), backward(0.2), first_half(0.2), second_half(0.2);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t j = points.size() - 1 - i;
    const auto color = [](std::size_t k) { return Rgb8{static_cast<std::uint8_t>(k % 256), 5, 7}; };
    forward.add_point(points[i], color(i));
    backward.add_point(points[j], color(j));
    (i < points.size() / 2 ? first_half : second_half).add_point(points[i], color(i));
  }
  second_half.add(first_half);
  const std::vector<Voxel> expected = voxels_of(forward);
  for (const VoxelSums* sums : {&backward, &second_half}) {
    const std::vector<Voxel> voxels = voxels_of(*sums);
    ASSERT_EQ(voxels.size(), expected.size());
    for (std::size_t i = 0; i < voxels.size(); ++i) {
      EXPECT_EQ(voxels[i].key, expected[i].key);
      EXPECT_EQ(voxels[i].count, expected[i].count);
      EXPECT_EQ(voxels[i].mean, expected[i].mean);
      EXPECT_EQ(voxels[i].color, expected[i].color);
    }
  }
}

TEST(VoxelSums, an_image_is_its_pixels_as_points) {
  const Camera camera = testkit::small_camera();
  const DepthImage depth = testkit::depth_image(1);
  const RgbImage color = testkit::color_image();
  const Rigid3 pose = testkit::walking_pose(3);
  VoxelSums image(0.25), points(0.25);
  image.add_image(depth, color, PixelRays(camera), pose, 0.5, 4);
  for (int v = 0; v < depth.height(); ++v)
    for (int u = 0; u < depth.width(); ++u)
      if (depth(u, v) > 0.5F && depth(u, v) <= 4)
        points.add_point(pose * *camera.back_project({u, v}, static_cast<double>(depth(u, v))), color(u, v));
  const std::vector<Voxel> voxels = voxels_of(image), expected = voxels_of(points);
  ASSERT_EQ(voxels.size(), expected.size());
  for (std::size_t i = 0; i < voxels.size(); ++i) {
    EXPECT_EQ(voxels[i].key, expected[i].key);
    EXPECT_EQ(voxels[i].count, expected[i].count);
    EXPECT_LT((voxels[i].mean - expected[i].mean).norm(), 0.25 / 512);
    EXPECT_EQ(voxels[i].color, expected[i].color);
  }
}

TEST(VoxelSums, only_depths_in_range_count) {
  DepthImage depth(64, 48, 0.0F);
  depth(10, 10) = 0.5F;  // the lower limit is not in the range, the upper one is
  depth(20, 10) = 4.0F;
  depth(30, 10) = 4.001F;
  depth(40, 10) = std::numeric_limits<float>::quiet_NaN();
  VoxelSums sums(0.1);
  sums.add_image(depth, {}, PixelRays(testkit::small_camera()), {}, 0.5, 4);
  ASSERT_EQ(sums.size(), 1U);
  EXPECT_NEAR(voxels_of(sums)[0].mean.z(), 4, 0.001);
  EXPECT_EQ(voxels_of(sums)[0].color, Rgb8{});
}

TEST(VoxelSums, refuse_what_does_not_fit) {
  EXPECT_THROW(VoxelSums(0), PreconditionError);
  VoxelSums sums(0.1);
  EXPECT_THROW(sums.add(VoxelSums(0.2)), PreconditionError);
  EXPECT_THROW(sums.add_point({1e9, 0, 0}, {}), InputError);
  EXPECT_THROW(sums.add_image(DepthImage(3, 3), {}, PixelRays(testkit::small_camera()), {}, 0, 4),
               PreconditionError);
}

}  // namespace
}  // namespace cairn
