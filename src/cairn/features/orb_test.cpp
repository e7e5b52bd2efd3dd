// SPDX-License-Identifier: Apache-2.0
#include "cairn/features/orb.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>

#include "cairn/core/executor.h"
#include "cairn/features/image_pyramid.h"
#include "cairn/testing/image/random_images.h"

namespace cairn {
namespace {

using testkit::blocky_image;
using testkit::random_image;

/// Blocks smoothed a little, as a lens would: corners at many scales.
GrayImage scene(int width, int height, std::uint64_t seed) {
  return smooth_for_brief(blocky_image(width, height, seed));
}

GrayImage turned_right(const GrayImage& image) {
  GrayImage turned(image.height(), image.width());
  for (int v = 0; v < image.height(); ++v)
    for (int u = 0; u < image.width(); ++u) turned(image.height() - 1 - v, u) = image(u, v);
  return turned;
}

int bits_between(const std::uint8_t* a, const std::uint8_t* b) {
  int bits = 0;
  for (int i = 0; i < 32; ++i) bits += std::popcount(static_cast<unsigned>(a[i] ^ b[i]));
  return bits;
}

bool same(const Features& a, const Features& b) {
  return a.keypoints.size() == b.keypoints.size() &&
         std::memcmp(a.keypoints.data(), b.keypoints.data(), a.keypoints.size() * sizeof(Keypoint)) == 0 &&
         std::memcmp(a.descriptors.words(), b.descriptors.words(), a.descriptors.count() * 32) == 0;
}

TEST(AngleByMoments, points_to_the_bright_side) {
  GrayImage image(41, 41, 0);
  for (int v = 0; v < 41; ++v)
    for (int u = 21; u < 41; ++u) image(u, v) = 200;
  EXPECT_FLOAT_EQ(angle_by_moments(image, 20, 20), 0);
  const GrayImage right = turned_right(image), twice = turned_right(right), thrice = turned_right(twice);
  EXPECT_FLOAT_EQ(angle_by_moments(right, 20, 20), 90);
  EXPECT_FLOAT_EQ(angle_by_moments(twice, 20, 20), 180);
  EXPECT_FLOAT_EQ(angle_by_moments(thrice, 20, 20), 270);
  EXPECT_EQ(angle_by_moments(GrayImage(41, 41, 9), 20, 20), 0);
  EXPECT_THROW((void)angle_by_moments(image, 18, 20), PreconditionError);
}

TEST(DescribeOrb, marks_and_counts_keypoints_whose_patch_leaves_the_image) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<Keypoint> keypoints{{60, 50}, {18.4F, 50}, {19, 19}, {80.4F, 60},
                                        {81, 60}, {-1e30F, 4}, {nan, 50}};
  const OrbDescriptions described = describe_orb(random_image(100, 100, 1), keypoints);
  EXPECT_EQ(described.bad, (std::vector<bool>{false, true, false, false, true, true, true}));
  EXPECT_EQ(described.bad_count, 4);
  EXPECT_EQ(described.angles_deg[1], -1);
  const std::vector<std::uint8_t> zeros(32);
  EXPECT_EQ(std::memcmp(described.descriptors.row(1), zeros.data(), 32), 0);
  EXPECT_NE(std::memcmp(described.descriptors.row(0), zeros.data(), 32), 0);
}

TEST(DescribeOrb, turns_with_the_image) {
  const GrayImage image = scene(201, 151, 2), turned = turned_right(image);
  std::vector<Keypoint> keypoints, turned_keypoints;
  for (int v = 20; v < 130; v += 10) {
    for (int u = 20; u < 180; u += 10) {
      keypoints.push_back({static_cast<float>(u), static_cast<float>(v)});
      turned_keypoints.push_back({static_cast<float>(150 - v), static_cast<float>(u)});
    }
  }
  const OrbDescriptions a = describe_orb(image, keypoints), b = describe_orb(turned, turned_keypoints);
  ASSERT_EQ(a.bad_count, 0);
  int bits = 0;
  for (std::size_t i = 0; i < keypoints.size(); ++i) {
    EXPECT_NEAR(std::remainder(b.angles_deg[i] - a.angles_deg[i] - 90, 360), 0, 0.01);
    bits += bits_between(a.descriptors.row(i), b.descriptors.row(i));
  }
  EXPECT_LT(bits, 2 * static_cast<int>(keypoints.size()));  // of 256 each: places rounded from exactly half
}

TEST(DescribeOrb, speaks_the_same_language_as_opencv) {
  const GrayImage image = scene(320, 240, 3);
  std::vector<Keypoint> keypoints;
  for (const Corner& corner : detect_fast(image, {20, 7, 32, 32}))
    keypoints.push_back({static_cast<float>(corner.u), static_cast<float>(corner.v)});
  ASSERT_GT(keypoints.size(), 100U);
  const OrbDescriptions ours = describe_orb(image, keypoints);
  std::vector<cv::KeyPoint> given;
  for (std::size_t i = 0; i < keypoints.size(); ++i)
    given.emplace_back(keypoints[i].u, keypoints[i].v, 31.0F, ours.angles_deg[i], 1.0F, 0,
                       static_cast<int>(i));
  cv::Mat theirs;
  const cv::Mat mat(240, 320, CV_8UC1, const_cast<std::uint8_t*>(image.data()));
  cv::ORB::create()->compute(mat, given, theirs);
  ASSERT_EQ(given.size(), keypoints.size());
  double bits = 0;
  for (int row = 0; row < theirs.rows; ++row) {
    const auto i = static_cast<std::size_t>(given[static_cast<std::size_t>(row)].class_id);
    bits += bits_between(ours.descriptors.row(i), theirs.ptr(row));
  }
  EXPECT_LT(bits / theirs.rows,
            6);  // of 256; the two smooth with other roundings. Strangers differ in about 128.
}

TEST(ExtractOrb, finds_a_scene_again_where_it_moved) {
  const GrayImage image = scene(320, 240, 4);
  GrayImage moved(320, 240, 100);
  constexpr int kRight = 7, kDown = 5;
  for (int v = kDown; v < 240; ++v)
    for (int u = kRight; u < 320; ++u) moved(u, v) = image(u - kRight, v - kDown);
  const Features a = extract_orb(image, {}), b = extract_orb(moved, {});
  int found = 0;
  for (const Keypoint& k : a.keypoints)
    found += std::any_of(b.keypoints.begin(), b.keypoints.end(), [&](const Keypoint& l) {
      return std::hypot(l.u - k.u - kRight, l.v - k.v - kDown) < k.sigma_px;
    });
  ASSERT_GT(a.keypoints.size(), 500U);
  EXPECT_GT(found, static_cast<int>(a.keypoints.size()) * 8 / 10);
}

TEST(ExtractOrb, keeps_to_the_count_and_to_the_image) {
  const GrayImage image = scene(320, 240, 5);
  for (const int count : {1, 10, 333, 100000}) {
    OrbOptions options;
    options.count = count;
    const Features features = extract_orb(image, options);
    EXPECT_LE(features.keypoints.size(), static_cast<std::size_t>(count));
    EXPECT_GE(features.keypoints.size(), static_cast<std::size_t>(std::min(count, 500)));
    for (const Keypoint& k : features.keypoints) {
      EXPECT_TRUE(k.u > 18 && k.v > 18 && k.u < 301 && k.v < 221);
      EXPECT_TRUE(k.angle_deg >= 0 && k.angle_deg < 360 && k.sigma_px >= 1);
    }
  }
}

TEST(ExtractOrb, takes_any_image) {
  for (int width = 0; width < 60; width += 7)
    for (int height = 0; height < 60; height += 7) (void)extract_orb(random_image(width, height, 6), {});
  EXPECT_FALSE(extract_orb(random_image(39, 39, 7), {}).descriptors.count() > 1);
  EXPECT_TRUE(extract_orb(GrayImage(640, 1, 8), {}).keypoints.empty());
  EXPECT_TRUE(extract_orb(GrayImage(300, 200, 8), {}).keypoints.empty());
}

TEST(ExtractOrb, gives_the_same_at_any_number_of_threads) {
  const GrayImage image = scene(400, 300, 8);
  const Features one = extract_orb(image, {});
  for (const int threads : {2, 3}) EXPECT_TRUE(same(extract_orb(image, {}, Executor(threads)), one));
}

}  // namespace
}  // namespace cairn
