// SPDX-License-Identifier: Apache-2.0
// The errors of broken files are in cloud_file_test.cpp, with those of the other formats.
#include "cairn/dense/pcd.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "cairn/core/error.h"
#include "cairn/testing/core/temporary_folder.h"

namespace cairn {
namespace {

constexpr const char* kXyz = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\n";

Cloud read_text(const std::string& contents) {
  const testkit::TemporaryFolder folder;
  return read_pcd(folder.write("cloud.pcd", contents));
}

TEST(Pcd, written_clouds_come_back) {
  const testkit::TemporaryFolder folder;
  const Cloud cloud{{{1.5F, -2, 3, 1, 2, 255}, {1e-30F, 1e30F, 0, 0, 128, 9}}};
  write_pcd(folder / "cloud.pcd", cloud);
  const Cloud read = read_pcd(folder / "cloud.pcd");
  EXPECT_EQ(read.points, cloud.points);
  EXPECT_TRUE(read.colored);
}

TEST(Pcd, width_times_height_counts_where_points_does_not) {
  const std::string three = "1 2 3\n4 5 6\n7 8 9\n";
  EXPECT_EQ(read_text(std::string(kXyz) + "WIDTH 1\nHEIGHT 2\nDATA ascii\n" + three).points,
            (std::vector<CloudPoint>{{1, 2, 3}, {4, 5, 6}}));
  for (const char* const counts : {"WIDTH 9\nHEIGHT 9\nPOINTS 1\n", "POINTS 1\nWIDTH 9\nHEIGHT 9\n"})
    EXPECT_EQ(read_text(std::string(kXyz).append(counts).append("DATA ascii\n").append(three)).points,
              (std::vector<CloudPoint>{{1, 2, 3}}));
}

TEST(Pcd, fields_are_of_four_bytes_unless_sizes_are_given) {
  const char one[] = "\0\0\x80\x3f";  // 1.0F
  const std::string bytes(one, 4);
  EXPECT_EQ(read_text("COLUMNS x y z\nPOINTS 1\nDATA binary\n" + bytes + bytes + bytes).points,
            (std::vector<CloudPoint>{{1, 1, 1}}));
}

/// Column by column: five times 1 and once 2; four bytes, sixteen more four bytes back, four bytes.
TEST(Pcd, compressed_points_are_those_of_the_plain_file) {
  const std::string header = "FIELDS x y z\nPOINTS 2\nDATA ";
  const std::string one("\0\0\x80\x3f", 4), two("\0\0\0\x40", 4);
  const std::string packed = '\x03' + one + "\xe0\x07\x03" + '\x03' + two;
  const std::string sizes("\x0d\0\0\0\x18\0\0\0", 8);
  const Cloud plain = read_text(header + "binary\n" + one + one + one + one + one + two);
  EXPECT_EQ(read_text(header + "binary_compressed\n" + sizes + packed).points, plain.points);
  EXPECT_THROW((void)read_text(header + "binary_compressed\n" + sizes + packed.substr(1)), InputError);
  const std::string larger("\x0d\0\0\0\x19\0\0\0", 8);
  EXPECT_THROW((void)read_text(header + "binary_compressed\n" + larger + packed), InputError);
}

TEST(Pcd, points_without_colour_are_not_coloured) {
  const Cloud cloud = read_text(std::string(kXyz) + "POINTS 1\nDATA ascii\n1 2 3\n");
  EXPECT_FALSE(cloud.colored);
  EXPECT_EQ(cloud.points, (std::vector<CloudPoint>{{1, 2, 3}}));
}

TEST(Pcd, a_header_without_fields_or_a_count_is_refused) {
  EXPECT_THROW((void)read_text("POINTS 1\nDATA ascii\n1 2 3\n"), InputError);
  EXPECT_THROW((void)read_text(std::string(kXyz) + "DATA ascii\n1 2 3\n"), InputError);
}

}  // namespace
}  // namespace cairn
