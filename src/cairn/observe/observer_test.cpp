// SPDX-License-Identifier: Apache-2.0
#include "cairn/observe/observer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cairn/core/random.h"
#include "cairn/testing/image/textured_pair.h"

namespace cairn {
namespace {

constexpr int kWidth = 320, kHeight = 240;
constexpr float kDepth = 2;

Calibration calibration() {
  Calibration result;
  result.camera = {CameraModel::pinhole, kWidth, kHeight, 260, 262, 160, 121, {}};
  return result;
}

Frame textured_frame() {
  const testkit::Waves waves(8, 30, 3);
  Frame frame;
  frame.id = {4};
  frame.stamp_ns = 77;
  frame.gray = testkit::make_pair(kWidth, kHeight, {}, waves, 1, 0).left;
  return frame;
}

Frame rgbd_frame() {
  Frame frame = textured_frame();
  frame.depth = DepthImage(kWidth, kHeight, kDepth);
  return frame;
}

int with_depth(const ObservedFrame& observed) {
  return static_cast<int>(std::count_if(observed.observations.begin(), observed.observations.end(),
                                        [](const Observation& o) { return o.has_disparity(); }));
}

TEST(ObserveRgbd, depth_becomes_disparity_of_a_virtual_baseline) {
  const ObserverOptions options;
  const Rig rig = rig_of(calibration(), options.depth_noise);
  EXPECT_EQ(rig.baseline, options.depth_noise.baseline);
  const ObservedFrame observed = Observer(calibration(), options).observe(rgbd_frame());
  ASSERT_GT(observed.observations.size(), 100U);
  EXPECT_EQ(observed.frame, FrameId{4});
  EXPECT_EQ(observed.stamp_ns, 77);
  EXPECT_EQ(observed.features.keypoints.size(), observed.observations.size());
  EXPECT_EQ(observed.features.descriptors.count(), observed.observations.size());
  for (std::size_t i = 0; i < observed.observations.size(); ++i) {
    const Observation& seen = observed.observations[i];
    EXPECT_NEAR(seen.d, rig.disparity(static_cast<double>(kDepth)), 1e-9);
    EXPECT_EQ(seen.sigma_d_px, options.depth_noise.at_start().sigma_px);
    const Eigen::Vector3d& point = observed.points_in_camera[i];
    EXPECT_NEAR(point.z(), static_cast<double>(kDepth), 1e-9);
    EXPECT_LT((rig.project(point) - Eigen::Vector3d(seen.u, seen.v, seen.d)).norm(), 1e-9);
  }
}

TEST(ObserveRgbd, a_feature_without_usable_depth_stays_without) {
  const Observer observer(calibration(), {});
  const ObservedFrame all = observer.observe(rgbd_frame());
  for (const float depth : {0.0F, 0.1F, 9.0F}) {  // unknown, too near, too far
    Frame frame = rgbd_frame();
    for (int v = 0; v < kHeight; ++v) std::fill(frame.depth.row(v), frame.depth.row(v) + kWidth / 2, depth);
    const ObservedFrame observed = observer.observe(frame);
    ASSERT_EQ(observed.observations.size(), all.observations.size());
    for (std::size_t i = 0; i < observed.observations.size(); ++i) {
      const Observation& seen = observed.observations[i];
      if (seen.u < kWidth / 2.0 - 1) {
        EXPECT_FALSE(seen.has_disparity());
      } else if (seen.u > kWidth / 2.0 + 30) {
        EXPECT_TRUE(seen.has_disparity());
      }
      EXPECT_EQ(observed.points_in_camera[i].allFinite(), seen.has_disparity());
    }
  }
}

TEST(ObserveRgbd, depth_beside_a_jump_is_not_believed) {
  Frame frame = rgbd_frame();
  for (int v = 0; v < kHeight; ++v) std::fill(frame.depth.row(v), frame.depth.row(v) + kWidth / 2, 1.0F);
  const ObserverOptions options;
  const ObservedFrame observed = Observer(calibration(), options).observe(frame);
  int beside = 0;
  for (const Observation& seen : observed.observations) {
    const double from_jump = std::abs(seen.u - (kWidth / 2.0 - 0.5));
    if (from_jump < options.depth_noise.jump_radius * seen.sigma_px - 1) {
      EXPECT_FALSE(seen.has_disparity()) << seen.u;
      ++beside;
    } else if (from_jump > options.depth_noise.jump_radius * seen.sigma_px + 2) {
      EXPECT_TRUE(seen.has_disparity()) << seen.u;
    }
  }
  EXPECT_GT(beside, 3);
}

/// Returns a frame of a wall at 2 m whose left half, if there is a `jump`, is at 1 m; disparities have a
/// noise of `sigma_px`.
Frame noisy_frame(double sigma_px, bool jump) {
  const Rig rig = rig_of(calibration(), {});
  Random random(9);
  Frame frame = rgbd_frame();
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      const double depth = jump && u < kWidth / 2 ? 1 : static_cast<double>(kDepth);
      frame.depth(u, v) = static_cast<float>(rig.depth(rig.disparity(depth) + sigma_px * random.normal()));
    }
  }
  return frame;
}

TEST(ObserveRgbd, noise_of_the_depth_is_no_jump) {
  const Observer observer(calibration(), {});
  const int all = with_depth(observer.observe(noisy_frame(0, false)));
  EXPECT_EQ(all, with_depth(observer.observe(rgbd_frame())));
  for (const double sigma_px : {0.05, 0.3, 0.6})
    EXPECT_GT(with_depth(observer.observe(noisy_frame(sigma_px, false))), 0.97 * all) << sigma_px;
}

TEST(ObserveRgbd, a_jump_is_seen_in_noise) {
  const ObserverOptions options;
  const ObservedFrame observed = Observer(calibration(), options).observe(noisy_frame(0.3, true));
  for (const Observation& seen : observed.observations) {
    const double from_jump = std::abs(seen.u - (kWidth / 2.0 - 0.5));
    if (from_jump > options.depth_noise.jump_radius * seen.sigma_px - 1) continue;
    EXPECT_FALSE(seen.has_disparity()) << seen.u;
  }
}

TEST(ObserveRgbd, pixels_are_undistorted) {
  Calibration distorted = calibration();
  distorted.camera.model = CameraModel::radtan;
  distorted.camera.distortion[0] = -0.2;
  const Observer straight(calibration(), {}), bent(distorted, {});
  const Frame frame = rgbd_frame();
  const ObservedFrame as_seen = straight.observe(frame), observed = bent.observe(frame);
  ASSERT_EQ(observed.observations.size(), as_seen.observations.size());
  const Rig rig = rig_of(distorted, {});
  double farthest = 0;
  for (std::size_t i = 0; i < observed.observations.size(); ++i) {
    const Observation &one = observed.observations[i], &other = as_seen.observations[i];
    const auto back = distorted.camera.project(rig.point_at(one.u, one.v, 1));
    ASSERT_TRUE(back);
    EXPECT_LT((*back - Eigen::Vector2d(other.u, other.v)).norm(), 1e-3);
    farthest = std::max(farthest, std::hypot(one.u - other.u, one.v - other.v));
  }
  EXPECT_GT(farthest, 5);
}

constexpr double kBaseline = 0.12;

Calibration stereo_calibration() {
  Calibration result = calibration();
  result.baseline = kBaseline;
  return result;
}

/// A surface of this disparity, in the middle of the image.
Frame stereo_frame(double disparity) {
  const testkit::Waves waves(8, 30, 3);
  const testkit::TestPair pair = testkit::make_pair(kWidth, kHeight, {disparity, 0.01, 0}, waves, 1, 1);
  Frame frame;
  frame.gray = pair.left;
  frame.right = pair.right;
  return frame;
}

TEST(ObserveStereo, measures_the_disparity_of_a_shifted_pair) {
  const ObservedFrame observed = Observer(stereo_calibration(), {}).observe(stereo_frame(11.4));
  const Rig rig = rig_of(stereo_calibration(), {});
  EXPECT_EQ(rig.baseline, kBaseline);
  ASSERT_GT(observed.observations.size(), 100U);
  EXPECT_EQ(observed.features.descriptors.count(), observed.observations.size());
  int right = 0;
  for (std::size_t i = 0; i < observed.observations.size(); ++i) {
    const Observation& seen = observed.observations[i];
    EXPECT_EQ(observed.points_in_camera[i].allFinite(), seen.has_disparity());
    if (!seen.has_disparity()) continue;
    right += std::abs(seen.d - (11.4 + 0.01 * (seen.u - 0.5 * kWidth))) < 0.5 ? 1 : 0;
    EXPECT_NEAR(observed.points_in_camera[i].z(), rig.depth(seen.d), 1e-9);
  }
  EXPECT_GT(with_depth(observed), static_cast<int>(observed.observations.size()) / 2);
  EXPECT_GE(right, 98 * with_depth(observed) / 100);
}

TEST(ObserveStereo, no_disparity_is_better_than_the_calibration) {
  const ObserverOptions options;
  const ObservedFrame observed = Observer(stereo_calibration(), options).observe(stereo_frame(11.4));
  EXPECT_GT(with_depth(observed), 50);
  for (const Observation& seen : observed.observations)
    if (seen.has_disparity()) {
      EXPECT_GE(seen.sigma_d_px, options.stereo_noise.sigma_floor_px);
    }
}

TEST(ObserveStereo, a_disparity_that_may_be_nothing_is_no_depth) {
  ObserverOptions options;
  options.stereo_noise.min_disparity_sigmas = 5;
  options.stereo_noise.sigma_floor_px = 3;  // 15 pixels
  const ObservedFrame observed = Observer(stereo_calibration(), options).observe(stereo_frame(11.4));
  EXPECT_GT(observed.observations.size(), 100U);
  EXPECT_EQ(with_depth(observed), 0);
}

TEST(ObserveStereo, nearer_than_the_least_depth_is_no_match) {
  ObserverOptions options;
  options.stereo_noise.min_depth = 260 * kBaseline / 8.0;
  const ObservedFrame observed = Observer(stereo_calibration(), options).observe(stereo_frame(11.4));
  for (const Observation& seen : observed.observations)
    if (seen.has_disparity()) {
      EXPECT_LE(seen.d, 8.01);
    }
}

TEST(Observer, an_image_without_texture_has_no_features) {
  Frame frame;
  frame.gray = GrayImage(kWidth, kHeight, 90);
  frame.depth = DepthImage(kWidth, kHeight, kDepth);
  EXPECT_TRUE(Observer(calibration(), {}).observe(frame).observations.empty());
}

}  // namespace
}  // namespace cairn
