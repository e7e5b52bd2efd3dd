// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/landmark_ply.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "cairn/core/file.h"
#include "cairn/map_files/map_file.h"
#include "cairn/report/colors.h"
#include "cairn/testing/core/temporary_folder.h"
#include "cairn/testing/map_files/scene_map.h"

namespace cairn {
namespace {

using testkit::scene_map;
using testkit::TemporaryFolder;

constexpr std::size_t kVertexBytes = 3 * 8 + 3 + 4;

struct Vertex {
  Eigen::Vector3d point;
  Rgb8 color;
  float std = 0;
};

/// What the file says of landmark number `i` of eight.
Vertex vertex(const std::string& ply, std::size_t i) {
  const std::string end = "end_header\n";
  const char* record = ply.data() + ply.find(end) + end.size() + i * kVertexBytes;
  Vertex result;
  std::memcpy(result.point.data(), record, 24);
  std::memcpy(&result.color, record + 24, 3);
  std::memcpy(&result.std, record + 27, 4);
  return result;
}

TEST(LandmarkPly, tells_standard_deviations_by_colour) {
  const TemporaryFolder folder;
  const Map map = scene_map();
  std::vector<Eigen::Matrix3d> covariances(map.landmarks().size(), Eigen::Matrix3d::Zero());
  const double infinite = std::numeric_limits<double>::infinity();
  covariances[1] =
      Eigen::Vector3d(1e-6, 1e-4, 1e-8).asDiagonal();  // landmark 0, as the first was erased: 1 cm
  covariances[2] = Eigen::Vector3d(1e-2, 1e-3, 1e-4).asDiagonal();  // 10 cm: halfway
  covariances[3] = Eigen::Vector3d(1e-2, 1e-3, 9).asDiagonal();     // 3 m
  covariances[4] = Eigen::Vector3d(1, 1, infinite).asDiagonal();
  write_map(folder.path() / "map", map, covariances);
  write_landmark_ply(folder.path() / "map", folder.path() / "landmarks.ply");
  const std::string ply = read_file(folder.path() / "landmarks.ply");
  EXPECT_NE(ply.find("element vertex 8\n"), std::string::npos);
  EXPECT_NE(ply.find("dark blue 0.01 m or less to orange 1 m or more"), std::string::npos);
  EXPECT_EQ(ply.size(), ply.find("end_header\n") + 11 + 8 * kVertexBytes);
  EXPECT_EQ(vertex(ply, 0).point, map[LandmarkId{1}].point_in_world);
  EXPECT_EQ(vertex(ply, 0).color, error_rgb(0));
  EXPECT_NEAR(vertex(ply, 0).std, 0.01, 1e-8);
  EXPECT_EQ(vertex(ply, 1).color, error_rgb(0.5));
  EXPECT_NEAR(vertex(ply, 1).std, 0.1, 1e-7);
  EXPECT_EQ(vertex(ply, 2).color, error_rgb(1));
  EXPECT_EQ(vertex(ply, 3).color, error_rgb(1));
  EXPECT_TRUE(std::isinf(vertex(ply, 3).std));
  EXPECT_EQ(vertex(ply, 7).color, (Rgb8{150, 150, 150}));
  EXPECT_TRUE(std::isnan(vertex(ply, 7).std));
}

}  // namespace
}  // namespace cairn
