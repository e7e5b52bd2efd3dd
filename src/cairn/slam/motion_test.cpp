// SPDX-License-Identifier: Apache-2.0
#include "cairn/slam/motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "cairn/core/random.h"

namespace cairn {
namespace {

constexpr Rig kRig{525, 525, 319.5, 239.5, 0.075};

/// Two frames that see the same points, each with its own random descriptor.
struct Views {
  ObservedFrame reference, current;
  Rigid3 current_from_reference;
  [[nodiscard]] ReferencePoints reference_view() const { return {reference, reference.points_in_camera}; }
};

void add_feature(ObservedFrame& frame, std::size_t i, const Eigen::Vector3d& point, Random& random) {
  const Eigen::Vector3d exact = kRig.project(point);
  const Observation seen{exact.x() + 0.3 * random.normal(), exact.y() + 0.3 * random.normal(),
                         exact.z() + 0.05 * random.normal(), 0.3 * M_SQRT2,
                         0.05 * M_SQRT2};  // both frames' noise enters
  frame.observations.push_back(seen);
  frame.points_in_camera.push_back(kRig.point_at(seen.u, seen.v, kRig.depth(seen.d)));
  frame.features.keypoints.push_back({static_cast<float>(seen.u), static_cast<float>(seen.v)});
  Random bytes(77, i);
  for (std::size_t b = 0; b < 32; ++b)
    frame.features.descriptors.row(i)[b] = static_cast<std::uint8_t>(bytes.index(256));
}

Views make_views(const Rigid3& current_from_reference, std::size_t count, std::uint64_t seed) {
  Random random(seed);
  Views views;
  views.current_from_reference = current_from_reference;
  for (ObservedFrame* frame : {&views.reference, &views.current})
    frame->features.descriptors = Descriptors(Norm::hamming, 32, count);
  views.reference.frame = {3};
  views.current.frame = {4};
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d point =
        kRig.point_at(random.uniform(40, 600), random.uniform(40, 440), random.uniform(1, 4));
    add_feature(views.reference, i, point, random);
    add_feature(views.current, i, current_from_reference * point, random);
  }
  return views;
}

Rigid3 small_motion() {
  return {rotation_exp({0.02, 0.05, -0.01}), {0.03, -0.01, 0.06}};
}

TEST(EstimateMotion, finds_the_motion) {
  const Views views = make_views(small_motion(), 300, 1);
  const Motion motion = estimate_motion(kRig, views.reference_view(), views.current, {});
  ASSERT_TRUE(motion.found);
  EXPECT_EQ(motion.matches, 300);
  EXPECT_GT(motion.inliers, 240);
  EXPECT_LT(motion_norm(motion.current_from_reference * views.current_from_reference.inverse()), 0.003);
  EXPECT_NEAR(motion.norm, motion_norm(small_motion()), 0.003);
}

TEST(EstimateMotion, finds_none_with_few_matches_or_without_depth) {
  const SlamOptions options;
  const Views few = make_views(small_motion(), static_cast<std::size_t>(options.min_matches) - 1, 2);
  EXPECT_FALSE(estimate_motion(kRig, few.reference_view(), few.current, options).found);
  Views flat = make_views(small_motion(), 300, 3);
  for (auto& point : flat.reference.points_in_camera)
    point.setConstant(std::numeric_limits<double>::quiet_NaN());
  const Motion motion = estimate_motion(kRig, flat.reference_view(), flat.current, options);
  EXPECT_FALSE(motion.found);
  EXPECT_EQ(motion.matches, 0);
}

/// Inliers enough, all far away in one corner of the image: translation is open.
TEST(EstimateMotion, finds_none_that_the_points_do_not_determine) {
  Views views = make_views(Rigid3{}, 60, 7);
  Random random(8);
  for (std::size_t i = 0; i < 60; ++i) {
    const Eigen::Vector3d point =
        kRig.point_at(300 + random.uniform(0, 15), 200 + random.uniform(0, 15), random.uniform(7.5, 8));
    for (ObservedFrame* frame : {&views.reference, &views.current}) {
      const Eigen::Vector3d seen = kRig.project(point);
      frame->observations[i] = {seen.x() + random.normal(), seen.y() + random.normal()};
      frame->points_in_camera[i] = point;
    }
  }
  const Motion motion = estimate_motion(kRig, views.reference_view(), views.current, {});
  EXPECT_GE(motion.inliers, 40);
  EXPECT_FALSE(motion.found);
}

TEST(EstimateMotion, finds_none_between_unrelated_frames) {
  const Views a = make_views(small_motion(), 300, 4), b = make_views(small_motion(), 300, 5);
  const Motion motion = estimate_motion(kRig, a.reference_view(), b.current, {});
  EXPECT_FALSE(motion.found) << motion.inliers;
}

Motion motion_of(double norm, int matches, int inliers) {
  Motion motion;
  motion.found = true;
  motion.norm = norm;
  motion.matches = matches;
  motion.inliers = inliers;
  return motion;
}

TEST(TrackingStatus, has_four_outcomes) {
  SlamOptions options;
  options.keyframe_threshold = 0.1;
  options.max_motion = 0.3;
  EXPECT_EQ(tracking_status(Motion{}, options), TrackingStatus::lost);
  EXPECT_EQ(tracking_status(motion_of(0.1, 100, 90), options), TrackingStatus::tracked);
  EXPECT_EQ(tracking_status(motion_of(0.11, 100, 90), options), TrackingStatus::keyframe);
  EXPECT_EQ(tracking_status(motion_of(0.3, 100, 90), options), TrackingStatus::implausible);
}

TEST(PlausibleLoop, needs_more_evidence_and_may_be_farther) {
  SlamOptions options;
  options.max_motion = 0.3;
  options.max_loop_motion = 5;
  EXPECT_TRUE(is_plausible_loop(motion_of(2, 100, 90), options));
  EXPECT_TRUE(is_plausible_loop(motion_of(0.01, 100, 90), options));  // no keyframe is asked for
  EXPECT_FALSE(is_plausible_loop(motion_of(5, 100, 90), options));
  EXPECT_FALSE(is_plausible_loop(motion_of(2, 100, options.loop_min_inliers - 1), options));
  EXPECT_FALSE(is_plausible_loop(motion_of(2, 1000, 100), options));  // a tenth
  EXPECT_FALSE(is_plausible_loop({}, options));
}

TEST(MotionNorm, adds_the_angle_to_the_way) {
  EXPECT_DOUBLE_EQ(motion_norm({rotation_exp({0, 0.4, 0}), {0, 0, 0.3}}), 0.7);
  EXPECT_NEAR(motion_norm({rotation_exp({0, 4.0, 0}), {0, 0, 0}}), 2 * M_PI - 4.0,
              1e-12);  // never more than pi
}

}  // namespace
}  // namespace cairn
