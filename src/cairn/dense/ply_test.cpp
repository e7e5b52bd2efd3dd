// SPDX-License-Identifier: Apache-2.0
// The errors of broken files are in cloud_file_test.cpp, with those of the other formats.
#include "cairn/dense/ply.h"

#include <gtest/gtest.h>

#include <cstdint>
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

const std::string kWithLists =
    "element vertex 2\nproperty float x\nproperty list uchar short views\nproperty float y\nproperty float "
    "z\n"
    "property list uint8 float weights\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n";
const std::vector<CloudPoint> kListed{{1, 2, 3, 10, 20, 30}, {-4, 5, 6, 40, 50, 60}};

TEST(Ply, lists_among_the_properties_of_vertices_are_skipped) {
  const Cloud cloud = read_text(kWithLists, "1 2 7 8 2 3 0 10 20 30\n\n-4 0 5 6 1 0.5 40 50 60\n");
  EXPECT_EQ(cloud.points, kListed);
  EXPECT_TRUE(cloud.colored);
}

template <class... Values>
std::string bytes_of(Values... values) {
  std::string bytes;
  (bytes.append(reinterpret_cast<const char*>(&values), sizeof values), ...);
  return bytes;
}

using U8 = std::uint8_t;
using I16 = std::int16_t;

Cloud read_lists(const std::string& data) {
  const testkit::TemporaryFolder folder;
  return read_ply(folder.write(
      "cloud.ply", "ply\nformat binary_little_endian 1.0\n" + kWithLists + "end_header\n" + data));
}

TEST(Ply, binary_lists_are_skipped_and_may_not_end_behind_the_file) {
  const std::string data = bytes_of(1.0F, U8{2}, I16{7}, I16{8}, 2.0F, 3.0F, U8{0}, U8{10}, U8{20}, U8{30}) +
                           bytes_of(-4.0F, U8{0}, 5.0F, 6.0F, U8{1}, 0.5F, U8{40}, U8{50}, U8{60});
  EXPECT_EQ(read_lists(data).points, kListed);
  EXPECT_THROW((void)read_lists(data.substr(0, data.size() - 1)), InputError);
  EXPECT_THROW((void)read_lists(bytes_of(1.0F, U8{255}, I16{7})), InputError);
}

TEST(Ply, lines_with_other_values_than_their_lists_announce_are_refused) {
  EXPECT_THROW((void)read_text(kWithLists, "1 2 7 2 3 0 10 20 30\n-4 0 5 6 0 40 50 60\n"), InputError);
  EXPECT_THROW((void)read_text(kWithLists, "1 99 7 8 2 3 0 10 20 30\n-4 0 5 6 0 40 50 60\n"), InputError);
  EXPECT_THROW((void)read_text("element vertex 1\nproperty list float int n\nproperty int x\n", "0 1\n"),
               InputError);
  EXPECT_THROW((void)read_text("element vertex 1\nproperty list uchar n\nproperty int x\n", "0 1\n"),
               InputError);
}

TEST(Ply, a_property_before_its_element_is_refused) {
  EXPECT_THROW((void)read_text("property float x\n", ""), InputError);
  EXPECT_THROW((void)read_text("", ""), InputError);
}

}  // namespace
}  // namespace cairn
