// SPDX-License-Identifier: Apache-2.0
#include "cairn/evaluate/landmark_consistency.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "cairn/core/random.h"
#include "cairn/image/codec.h"
#include "cairn/map_files/map_file.h"
#include "cairn/testing/core/message_of.h"
#include "cairn/testing/core/temporary_folder.h"

namespace cairn {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int kWidth = 200, kHeight = 150, kFrames = 4;
constexpr double kFocal = 180, kWallZ = 9;
constexpr Rig kRig{kFocal, kFocal, 99.5, 74.5, 0.5};
constexpr int kSkyRows = 30;

/// The camera drives towards a wall that ends below the sky, a metre a frame, in a curve: places on a
/// straight line would leave the rotation of an alignment open.
Rigid3 world_from_camera(int frame) {
  return {rotation_exp({0, 0.03 * frame, 0}), {0.2 * frame * frame, 0, 1.0 * frame}};
}

/// How far the wall, the plane z = 9 of the world, is along the ray of a pixel.
double wall_depth(int frame, double u, double v) {
  const Rigid3 pose = world_from_camera(frame);
  const Vector3d ray = pose.rotation * kRig.point_at(u, v, 1);
  return (kWallZ - pose.translation.z()) / ray.z();
}

/// What a map holds: landmarks around the wall, and what is wrong with them.
struct MapOptions {
  double stretch = 1;  ///< true variance over the stated one
  Rigid3 world = {};   ///< of the map, from that of the truth
  Rig rig = kRig;
  std::int64_t first_stamp_ns = 0;
  int odd_landmarks = 0;  ///< of each kind: without covariance, undetermined, in the sky
};

class LandmarkConsistency : public testing::Test {
 protected:
  LandmarkConsistency() {
    std::string times, poses;
    for (int i = 0; i < kFrames; ++i) {
      const std::string name = fmt::format("{:06}.png", i);
      for (const char* camera : {"image_0", "image_1"}) {
        (void)folder_.make_folder(fmt::format("seq/{}", camera));
        write_png(folder_ / fmt::format("seq/{}/{}", camera, name), GrayImage(kWidth, kHeight, 90));
      }
      (void)folder_.make_folder("seq/depth_truth");
      RawDepthImage depth(kWidth, kHeight);
      for (int v = kSkyRows; v < kHeight; ++v)
        for (int u = 0; u < kWidth; ++u)
          depth(u, v) = static_cast<std::uint16_t>(std::lround(256 * wall_depth(i, u, v)));
      write_png(folder_ / ("seq/depth_truth/" + name), depth);
      times += fmt::format("{:.1f}\n", 0.1 * i);
      const Rigid3 pose = world_from_camera(i);
      const Matrix3d r = pose.matrix3();
      for (int row = 0; row < 3; ++row)
        poses += fmt::format("{:.15g} {:.15g} {:.15g} {:.15g} ", r(row, 0), r(row, 1), r(row, 2),
                             pose.translation[row]);
      poses += "\n";
    }
    folder_.write("seq/times.txt", times);
    folder_.write("seq/poses.txt", poses);
    folder_.write("seq/calib.txt",
                  "P0: 180 0 99.5 0 0 180 74.5 0 0 0 1 0\nP1: 180 0 99.5 -90 0 180 74.5 0 0 0 1 0\n");
  }

  /// Writes a map of `count` landmarks on the wall with errors of their covariances.
  void make_map(const MapOptions& options, int count = 1500) const {
    Random random(5);
    Map map(options.rig, "ORB");
    std::vector<Matrix3d> covariances;
    const int all = count + 3 * options.odd_landmarks;
    for (int k = 0; k < kFrames; ++k) {
      ObservedFrame frame;
      frame.frame = {k};
      frame.stamp_ns = options.first_stamp_ns + 100'000'000LL * k;
      frame.features.descriptors = Descriptors(Norm::hamming, 32, static_cast<std::size_t>(all));
      for (int i = 0; i < all; ++i) {
        frame.features.keypoints.push_back({10, 10, 31, 0, 0, 1});
        frame.observations.push_back({10, 10, 5, 1, 1});
        frame.points_in_camera.emplace_back(0, 0, 5);
      }
      map.add_keyframe(std::move(frame), options.world * world_from_camera(k),
                       k == 0 ? KeyframeId{} : KeyframeId{k - 1}, 0);
    }
    for (int i = 0; i < all; ++i) {
      const int kind = i < count ? 0 : 1 + (i - count) % 3;
      const double u = random.uniform(60, 140);
      const double v = kind == 3 ? 5 : random.uniform(60, kHeight - 10);
      const Vector3d sigmas(0.01, 0.02, random.uniform(0.02, 0.3));
      const Matrix3d turn = rotation_exp({random.normal(), random.normal(), 0}).toRotationMatrix();
      const Matrix3d covariance = turn * sigmas.cwiseAbs2().asDiagonal() * turn.transpose();
      const Vector3d unit(random.normal(), random.normal(), random.normal());
      const Vector3d point = world_from_camera(3) * kRig.point_at(u, v, wall_depth(3, u, v)) +
                             std::sqrt(options.stretch) * (turn * sigmas.cwiseProduct(unit));
      const LandmarkId id = map.add_landmark(options.world * point, {{0}, i});
      map.add_observation(id, {{3}, i});  // the nearest
      const Matrix3d turned = options.world.matrix3() * covariance * options.world.matrix3().transpose();
      covariances.push_back(kind == 1   ? Matrix3d::Zero()
                            : kind == 2 ? Matrix3d(std::numeric_limits<double>::infinity() * Matrix3d::Ones())
                                        : Matrix3d(0.5 * (turned + turned.transpose())));
    }
    std::filesystem::remove_all(folder_ / "map");
    write_map(folder_ / "map", map, covariances);
  }

  [[nodiscard]] LandmarkEvaluation evaluate(AlignmentMode alignment = AlignmentMode::none) const {
    const Sequence sequence = open_sequence(folder_ / "seq");
    return evaluate_landmarks(folder_ / "map", sequence, {alignment, 0.02}, Executor(2));
  }
  [[nodiscard]] std::string message() const {
    return testkit::message_of([&] { return evaluate(); });
  }

  testkit::TemporaryFolder folder_;
};

TEST_F(LandmarkConsistency, FindsHonestLandmarksHonest) {
  make_map({});
  const LandmarkEvaluation found = evaluate();
  EXPECT_EQ(found.landmarks, 1500U);
  EXPECT_EQ(found.judged, 1500U);
  EXPECT_EQ(found.at_edges, 0U);
  EXPECT_EQ(found.keyframe_pairs, 4U);
  EXPECT_LT(found.keyframe_error_m, 1e-9);
  ASSERT_TRUE(found.all);
  const ConsistencyReport& report = found.all->report;
  EXPECT_EQ(report.degrees_of_freedom, 1);
  EXPECT_NEAR(report.mean_nees, 1, 0.1);
  EXPECT_EQ(report.verdict, CovarianceVerdict::honest);
  for (const Coverage& coverage : report.coverage)
    EXPECT_LT(std::abs(coverage.actual - coverage.nominal), 3.5 * coverage.standard_error);
  EXPECT_NEAR(found.all->std_per_error() / found.all->honest_std_per_error(), 1, 0.1);
  std::size_t count = 0;
  for (const LandmarkClass& one : found.by_distance) {
    EXPECT_LT(one.from, one.to);
    count += one.consistency.report.count;
  }
  EXPECT_EQ(count, 1500U);
  ASSERT_EQ(found.by_observations.size(), 1U);  // all have two
  EXPECT_EQ(found.by_observations[0].from, 1);
  EXPECT_EQ(found.by_observations[0].to, 3);
  EXPECT_EQ(found.by_observations[0].consistency.report.count, 1500U);
}

TEST_F(LandmarkConsistency, FindsLiarsOut) {
  make_map({.stretch = 4});
  EXPECT_NEAR(evaluate().all->report.mean_nees, 4, 0.4);
  EXPECT_EQ(evaluate().all->report.verdict, CovarianceVerdict::overconfident);
}

TEST_F(LandmarkConsistency, LeavesNoLandmarkOutUnsaid) {
  make_map({.odd_landmarks = 5}, 100);
  const LandmarkEvaluation found = evaluate();
  EXPECT_EQ(found.landmarks, 115U);
  EXPECT_EQ(found.judged, 100U);
  EXPECT_EQ(found.without_covariance, 5U);
  EXPECT_EQ(found.undetermined, 5U);
  EXPECT_EQ(found.without_truth, 5U);
}

TEST_F(LandmarkConsistency, AlignsAWorldOfItsOwn) {
  make_map({});
  const double expected = evaluate().all->report.mean_nees;
  make_map({.world = {rotation_exp({0.5, 1, -2}), {30, -10, 5}}});
  EXPECT_NE(message().find("map: expected a map in the world of the truth"), std::string::npos) << message();
  EXPECT_NE(message().find("--align se3"), std::string::npos);
  const LandmarkEvaluation found = evaluate(AlignmentMode::se3);
  ASSERT_EQ(found.alignment_status, AlignmentStatus::ok);
  EXPECT_NEAR(found.all->report.mean_nees, expected, 1e-3);
  EXPECT_LT(found.keyframe_error_m, 1e-6);
}

TEST_F(LandmarkConsistency, SaysWhatDoesNotBelongTogether) {
  make_map({.rig = {181, kFocal, 99.5, 74.5, 0.5}}, 10);
  EXPECT_NE(message().find("expected a map of the camera of"), std::string::npos) << message();
  make_map({.first_stamp_ns = 1'000'000'000'000}, 10);
  EXPECT_NE(message().find("expected keyframes within 0.02 s of the frames of"), std::string::npos);
  make_map({}, 10);
  write_png(folder_ / "seq/depth_truth/000003.png", RawDepthImage(kWidth, 10));
  EXPECT_NE(message().find("000003.png: expected 200x150 pixels, as the camera has, found 200x10"),
            std::string::npos);
  std::filesystem::remove_all(folder_ / "seq/depth_truth");
  EXPECT_NE(message().find("seq: expected a simulated sequence with the true depth in depth_truth/"),
            std::string::npos);
}

}  // namespace
}  // namespace cairn
