// SPDX-License-Identifier: Apache-2.0
#include "cairn/dense/depth_edges.h"

#include <gtest/gtest.h>

#include <vector>

namespace cairn {
namespace {

constexpr int kWidth = 9, kHeight = 7;

/// Columns of a row that are left.
std::vector<int> left_in_row(const DepthImage& depth, int v) {
  std::vector<int> columns;
  for (int u = 0; u < depth.width(); ++u)
    if (depth(u, v) > 0) columns.push_back(u);
  return columns;
}

TEST(DepthEdges, two_pixels_on_both_sides_of_a_step_go) {
  DepthImage depth(kWidth, kHeight, 1.0F);
  for (int v = 0; v < kHeight; ++v)
    for (int u = 5; u < kWidth; ++u) depth(u, v) = 1.2F;
  const DepthImage kept = without_depth_edges(depth, 0.1);
  for (int v = 0; v < kHeight; ++v) EXPECT_EQ(left_in_row(kept, v), (std::vector<int>{0, 1, 2, 7, 8})) << v;
  EXPECT_EQ(kept(0, 0), 1.0F);
  EXPECT_EQ(kept(8, 0), 1.2F);
}

TEST(DepthEdges, two_rows_above_and_below_a_step_go) {
  DepthImage depth(kWidth, kHeight, 2.0F);
  for (int u = 0; u < kWidth; ++u)
    for (int v = 4; v < kHeight; ++v) depth(u, v) = 1.0F;
  const DepthImage kept = without_depth_edges(depth, 0.1);
  for (int v = 0; v < kHeight; ++v)
    EXPECT_EQ(left_in_row(kept, v).size(), v < 2 || v > 5 ? static_cast<std::size_t>(kWidth) : 0U) << v;
}

TEST(DepthEdges, the_step_is_a_share_of_the_smaller_depth) {
  DepthImage depth(3, 1);
  depth(0, 0) = 10.0F;
  depth(1, 0) = 10.0F;
  depth(2, 0) = 11.1F;
  EXPECT_TRUE(left_in_row(without_depth_edges(depth, 0.12), 0).size() == 3);
  EXPECT_EQ(left_in_row(without_depth_edges(depth, 0.105), 0), (std::vector<int>{1}));
}

TEST(DepthEdges, pixels_without_depth_make_no_edge) {
  DepthImage depth(kWidth, kHeight, 3.0F);
  for (int v = 0; v < kHeight; ++v) depth(4, v) = 0;
  EXPECT_EQ(left_in_row(without_depth_edges(depth, 0.05), 3), (std::vector<int>{0, 1, 2, 3, 5, 6, 7, 8}));
}

}  // namespace
}  // namespace cairn
