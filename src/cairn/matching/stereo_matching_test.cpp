// SPDX-License-Identifier: Apache-2.0
#include "cairn/matching/stereo_matching.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "cairn/core/error.h"
#include "cairn/core/executor.h"
#include "cairn/core/random.h"
#include "cairn/matching/matching.h"
#include "cairn/testing/image/textured_pair.h"

namespace cairn {
namespace {

using testkit::make_pair;
using testkit::TestPair;
using testkit::Waves;

constexpr int kWidth = 200, kHeight = 60;
const Rig kRig{100, 100, 100, 30, 0.2};  // disparity = 20 / depth

/// Few different descriptors and rows, so that there are many candidates and ties.
Features random_features(Norm norm, std::size_t count, std::uint64_t seed) {
  Random random(seed);
  Features features;
  features.descriptors = Descriptors(norm, 32, count);
  for (std::size_t i = 0; i < count; ++i) {
    Keypoint keypoint;
    keypoint.u = static_cast<float>(random.uniform(0, kWidth - 1));
    keypoint.v = static_cast<float>(random.uniform(0, kHeight - 1));
    keypoint.sigma_px = random.index(2) == 0 ? 1.F : 1.44F;
    keypoint.size = 31 * keypoint.sigma_px;
    features.keypoints.push_back(keypoint);
    features.descriptors.row(i)[0] = static_cast<std::uint8_t>(random.index(8));
    features.descriptors.row(i)[31] = static_cast<std::uint8_t>(random.index(4));
  }
  return features;
}

float slow_distance(const Descriptors& a, std::size_t i, const Descriptors& b, std::size_t j) {
  Descriptors one(a.norm(), a.bytes(), 1), other(b.norm(), b.bytes(), 1);
  std::copy_n(a.row(i), a.bytes(), one.row(0));
  std::copy_n(b.row(j), b.bytes(), other.row(0));
  return match_mutual(one, other).front().distance;
}

bool slow_may_match(const Keypoint& a, const Keypoint& b, const StereoMatchOptions& options) {
  const float reach = static_cast<float>(options.row_band) * std::max(a.sigma_px, b.sigma_px);
  const float low = static_cast<float>(kRig.disparity(options.max_depth)),
              high = static_cast<float>(kRig.disparity(options.min_depth));
  return std::abs(a.v - b.v) <= reach && a.u - b.u >= low - reach && a.u - b.u <= high + reach &&
         std::max(a.size, b.size) <= static_cast<float>(options.max_size_ratio) * std::min(a.size, b.size);
}

/// Index of the nearest of `to` for feature i of `from`, or -1; `left` says which side `from` is.
std::int32_t slow_nearest(const Features& from, std::size_t i, const Features& to, bool from_is_left,
                          const StereoMatchOptions& options) {
  std::int32_t best = -1;
  float least = std::numeric_limits<float>::infinity();
  for (std::size_t j = 0; j < to.keypoints.size(); ++j) {
    const Keypoint &a = from.keypoints[i], &b = to.keypoints[j];
    if (!(from_is_left ? slow_may_match(a, b, options) : slow_may_match(b, a, options))) continue;
    const float distance = slow_distance(from.descriptors, i, to.descriptors, j);
    if (distance < least) least = distance, best = static_cast<std::int32_t>(j);
  }
  return best;
}

/// Without texture nothing is measured: what is left is the search.
TEST(MatchStereo, the_search_agrees_with_the_definition) {
  const GrayImage blank(kWidth, kHeight, 100);
  StereoMatchOptions options;
  options.min_depth = 0.4, options.max_depth = 10;
  int found = 0;
  for (const Norm norm : {Norm::hamming, Norm::l2}) {
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
      const Features left = random_features(norm, 150, seed), right = random_features(norm, 137, 100 + seed);
      const auto matches = match_stereo(kRig, {left, blank}, {right, blank}, options);
      ASSERT_EQ(matches.size(), left.keypoints.size());
      for (std::size_t l = 0; l < matches.size(); ++l) {
        const std::int32_t r = slow_nearest(left, l, right, true, options);
        const bool mutual = r >= 0 && slow_nearest(right, static_cast<std::size_t>(r), left, false,
                                                   options) == static_cast<std::int32_t>(l);
        const double disparity =
            r < 0 ? 0
                  : static_cast<double>(left.keypoints[l].u) -
                        static_cast<double>(right.keypoints[static_cast<std::size_t>(r)].u);
        const bool in_range =
            disparity >= kRig.disparity(options.max_depth) && disparity <= kRig.disparity(options.min_depth);
        ASSERT_EQ(matches[l].has_value(), mutual && in_range) << "left feature " << l;
        if (!matches[l]) continue;
        ++found;
        EXPECT_EQ(matches[l]->right, r);
        EXPECT_EQ(matches[l]->disparity, disparity);
        EXPECT_FALSE(matches[l]->measured);
        EXPECT_EQ(matches[l]->distance,
                  slow_distance(left.descriptors, l, right.descriptors, static_cast<std::size_t>(r)));
      }
    }
  }
  EXPECT_GT(found, 100);
}

/// Features at known places of a textured plane, each with a descriptor of its own.
struct Plane {
  static constexpr double kDisparity = 14.37;
  TestPair images = make_pair(kWidth, kHeight, {kDisparity, 0, 0}, Waves(5, 25, 1), 1, 1);
  Features left, right;

  explicit Plane(std::size_t count) {
    Random random(5);
    left.descriptors = right.descriptors = Descriptors(Norm::hamming, 32, count);
    for (std::size_t i = 0; i < count; ++i) {
      Keypoint keypoint;
      keypoint.size = 31;
      keypoint.u = static_cast<float>(random.uniform(30, kWidth - 12));
      keypoint.v = static_cast<float>(random.uniform(8, kHeight - 8));
      left.keypoints.push_back(keypoint);
      keypoint.u += static_cast<float>(random.uniform(-0.5, 0.5) - kDisparity);
      keypoint.v += static_cast<float>(random.uniform(-1, 1));
      right.keypoints.push_back(keypoint);
      std::generate_n(left.descriptors.row(i), 32,
                      [&] { return static_cast<std::uint8_t>(random.index(256)); });
      std::copy_n(left.descriptors.row(i), 32, right.descriptors.row(i));
    }
  }
};

TEST(MatchStereo, measures_the_disparity_on_the_images) {
  const Plane plane(200);
  const auto matches =
      match_stereo(kRig, {plane.left, plane.images.left}, {plane.right, plane.images.right}, {});
  int measured = 0;
  for (std::size_t l = 0; l < matches.size(); ++l) {
    if (!matches[l] || !matches[l]->measured) continue;
    ++measured;
    EXPECT_EQ(matches[l]->right, static_cast<std::int32_t>(l));
    EXPECT_NEAR(matches[l]->disparity, Plane::kDisparity, 0.15);
    EXPECT_NEAR(matches[l]->disparity, Plane::kDisparity, 5 * matches[l]->sigma_disparity_px);
    EXPECT_LT(matches[l]->sigma_disparity_px, 0.2);
  }
  EXPECT_GT(measured, 190);
}

TEST(MatchStereo, features_without_a_partner_are_found_in_the_image) {
  Plane plane(100);
  plane.right = {};
  plane.right.descriptors = Descriptors(plane.left.descriptors.norm(), plane.left.descriptors.bytes(), 0);
  StereoMatchOptions options;
  options.search_images = true;
  std::size_t found = 0;
  for (const auto& match :
       match_stereo(kRig, {plane.left, plane.images.left}, {plane.right, plane.images.right}, options)) {
    if (!match) continue;
    ++found;
    EXPECT_EQ(match->right, -1);
    EXPECT_NEAR(match->disparity, Plane::kDisparity, 0.3);
  }
  EXPECT_GE(2 * found, plane.left.keypoints.size());
}

TEST(MatchStereo, the_images_reveal_a_wrong_match) {
  Plane plane(1);
  plane.right.keypoints[0].u -= 6;  // a place that looks different
  EXPECT_FALSE(match_stereo(kRig, {plane.left, plane.images.left}, {plane.right, plane.images.right}, {})[0]);
}

TEST(MatchStereo, gives_the_same_on_any_number_of_threads) {
  const Plane plane(300);
  const StereoSide left{plane.left, plane.images.left}, right{plane.right, plane.images.right};
  const auto one = match_stereo(kRig, left, right, {});
  EXPECT_GT(std::count_if(one.begin(), one.end(), [](const auto& match) { return match.has_value(); }), 100);
  for (const int threads : {2, 5}) {
    const auto several = match_stereo(kRig, left, right, {}, Executor(threads));
    ASSERT_EQ(several.size(), one.size());
    for (std::size_t l = 0; l < one.size(); ++l) {
      ASSERT_EQ(several[l].has_value(), one[l].has_value());
      if (!one[l]) continue;
      EXPECT_EQ(several[l]->right, one[l]->right);
      EXPECT_EQ(several[l]->disparity, one[l]->disparity);
      EXPECT_EQ(several[l]->sigma_disparity_px, one[l]->sigma_disparity_px);
    }
  }
}

TEST(MatchStereo, limits_hold) {
  Plane plane(1);
  const StereoSide left{plane.left, plane.images.left}, right{plane.right, plane.images.right};
  const auto found = [&](const StereoMatchOptions& options) {
    return match_stereo(kRig, left, right, options)[0].has_value();
  };
  StereoMatchOptions options;
  EXPECT_TRUE(found(options));
  options.min_depth = 2;  // disparities to 10
  EXPECT_FALSE(found(options));
  options = {};
  options.max_depth = 1;  // from 20
  EXPECT_FALSE(found(options));
  options = {};
  plane.right.descriptors.row(0)[0] ^= 7;
  options.max_distance = 3;
  EXPECT_TRUE(found(options));
  options.max_distance = 2.5;
  EXPECT_FALSE(found(options));
  options = {};
  plane.right.keypoints[0].size *= 1.6F;
  EXPECT_FALSE(found(options));
  options.max_size_ratio = 1.7;
  EXPECT_TRUE(found(options));
  plane.right.keypoints[0].v = plane.left.keypoints[0].v + 2.5F;
  EXPECT_FALSE(found(options));
  options.row_band = 3;
  EXPECT_TRUE(found(options));
}

TEST(MatchStereo, a_rival_fails_the_ratio_test) {
  Plane plane(2);
  plane.right.keypoints[1] = plane.right.keypoints[0];
  plane.right.keypoints[1].u += 5;
  std::copy_n(plane.right.descriptors.row(0), 32, plane.right.descriptors.row(1));
  plane.right.descriptors.row(0)[0] ^= 1;
  plane.right.descriptors.row(1)[0] ^= 3;
  StereoMatchOptions options;
  options.max_ratio = 0.6;
  const StereoSide left{plane.left, plane.images.left}, right{plane.right, plane.images.right};
  EXPECT_TRUE(match_stereo(kRig, left, right, options)[0]);
  options.max_ratio = 0.5;
  EXPECT_FALSE(match_stereo(kRig, left, right, options)[0]);
}

TEST(MatchStereo, nothing_on_a_side_is_nothing_matched) {
  const Plane plane(3);
  const Features none;
  const GrayImage no_image;
  const auto matches = match_stereo(kRig, {plane.left, plane.images.left}, {none, plane.images.right}, {});
  ASSERT_EQ(matches.size(), 3U);
  for (const auto& match : matches) EXPECT_FALSE(match);
  EXPECT_TRUE(match_stereo(kRig, {none, plane.images.left}, {plane.left, plane.images.right}, {}).empty());
  EXPECT_TRUE(match_stereo(kRig, {none, no_image}, {none, no_image}, {}).empty());
}

TEST(MatchStereo, numbers_that_are_none_do_not_spread) {
  Plane plane(40);
  const float nan = std::numeric_limits<float>::quiet_NaN(),
              infinity = std::numeric_limits<float>::infinity();
  plane.left.keypoints[0].u = nan, plane.left.keypoints[1].v = infinity,
  plane.left.keypoints[2].sigma_px = nan;
  plane.right.keypoints[3].v = nan, plane.right.keypoints[4].u = -infinity,
  plane.right.keypoints[5].size = nan;
  const auto matches =
      match_stereo(kRig, {plane.left, plane.images.left}, {plane.right, plane.images.right}, {});
  int found = 0;
  for (std::size_t l = 0; l < matches.size(); ++l) {
    if (!matches[l]) continue;
    ++found;
    EXPECT_GT(l, 5U);
    EXPECT_TRUE(std::isfinite(matches[l]->disparity) && matches[l]->disparity > 0);
    EXPECT_TRUE(std::isfinite(matches[l]->sigma_disparity_px) && matches[l]->sigma_disparity_px > 0);
  }
  EXPECT_GT(found, 30);
}

TEST(MatchStereo, refuses_what_has_no_meaning) {
  const Plane plane(2);
  const StereoSide left{plane.left, plane.images.left}, right{plane.right, plane.images.right};
  for (const auto& [min_depth, max_depth] :
       {std::pair(0.0, 1.0), std::pair(2.0, 1.0), std::pair(-1.0, 1.0)}) {
    StereoMatchOptions options;
    options.min_depth = min_depth, options.max_depth = max_depth;
    EXPECT_THROW((void)match_stereo(kRig, left, right, options), PreconditionError);
  }
  const GrayImage other_size(10, 10);
  EXPECT_THROW((void)match_stereo(kRig, left, {plane.right, other_size}, {}), PreconditionError);
  Rig no_baseline = kRig;
  no_baseline.baseline = 0;
  EXPECT_THROW((void)match_stereo(no_baseline, left, right, {}), PreconditionError);
}

}  // namespace
}  // namespace cairn
