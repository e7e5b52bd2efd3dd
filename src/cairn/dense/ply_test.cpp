// SPDX-License-Identifier: Apache-2.0
// The errors of broken files are in cloud_file_test.cpp, with those of the other formats.
#include "cairn/dense/ply.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "cairn/core/error.h"
#include "cairn/testing/core/temporary_folder.h"

namespace cairn {
namespace {

Cloud read_text(const std::string& header, const std::string& data) {
  const testkit::TemporaryFolder folder;
  return read_ply(folder.write("cloud.ply", "ply\nformat ascii 1.0\n" + header + "end_header\n" + data));
}

TEST(Ply, written_clouds_come_back) {
  const testkit::TemporaryFolder folder;
  const Cloud cloud{{{1.5F, -2, 3, 1, 2, 255}, {1e-30F, 1e30F, 0, 0, 128, 9}}};
  write_ply(folder / "cloud.ply", cloud);
  const Cloud read = read_ply(folder / "cloud.ply");
  EXPECT_EQ(read.points, cloud.points);
  EXPECT_TRUE(read.colored);
}

TEST(Ply, properties_have_any_order_and_either_name_of_their_type) {
  const Cloud cloud = read_text(
      "element vertex 1\nproperty uint8 blue\nproperty float64 z\nproperty uchar red\n"
      "property float32 x\nproperty uchar green\nproperty double y\n",
      "30 3 10 1 20 2\n");
  EXPECT_EQ(cloud.points, (std::vector<CloudPoint>{{1, 2, 3, 10, 20, 30}}));
}

TEST(Ply, what_follows_the_vertices_is_skipped) {
  const Cloud cloud = read_text(
      "comment element face 1\nelement vertex 1\nproperty int x\nproperty int y\n"
      "property int z\nelement face 1\nproperty list uchar int vertex_indices\n"
      "obj_info x\n",
      "1 2 3\n3 0 0 0\n");
  EXPECT_EQ(cloud.points, (std::vector<CloudPoint>{{1, 2, 3}}));
  EXPECT_FALSE(cloud.colored);
}

TEST(Ply, a_property_before_its_element_is_refused) {
  EXPECT_THROW((void)read_text("property float x\n", ""), InputError);
  EXPECT_THROW((void)read_text("", ""), InputError);
}

}  // namespace
}  // namespace cairn
