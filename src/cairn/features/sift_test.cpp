// SPDX-License-Identifier: Apache-2.0
#include "cairn/features/sift.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>

#include "cairn/core/error.h"
#include "cairn/core/random.h"
#include "cairn/features/sift_descriptor.h"
#include "cairn/features/sift_orientation.h"
#include "cairn/matching/matching.h"

namespace cairn {
namespace {

struct Blob {
  double u, v, sigma, height;
};

/// A sum of Gaussians on grey.
GrayImage draw(int width, int height, const std::vector<Blob>& blobs) {
  GrayImage image(width, height);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      double value = 128;
      for (const Blob& blob : blobs)
        value += blob.height * std::exp(-(std::pow(u - blob.u, 2) + std::pow(v - blob.v, 2)) /
                                        (2 * blob.sigma * blob.sigma));
      image(u, v) = static_cast<std::uint8_t>(std::clamp(std::lround(value), 0L, 255L));
    }
  }
  return image;
}

/// Blobs of random place, scale and height, drawn as seen after x -> scale * R(angle) * x about the centre.
GrayImage texture(int size, double angle = 0, double scale = 1, double contrast = 1) {
  Random random(7);
  std::vector<Blob> blobs;
  for (int i = 0; i < 150; ++i) {
    const double x = random.uniform(-0.5, 0.5) * size, y = random.uniform(-0.5, 0.5) * size;
    const double sigma = random.uniform(1.5, 7), height = random.uniform(-60, 60);
    const double centre = (size - 1) / 2.0;
    blobs.push_back({centre + scale * (std::cos(angle) * x - std::sin(angle) * y),
                     centre + scale * (std::sin(angle) * x + std::cos(angle) * y), scale * sigma,
                     contrast * height});
  }
  return draw(size, size, blobs);
}

Features extract(const GrayImage& image, const SiftOptions& options = {}, int threads = 1) {
  return make_sift_extractor(options)->extract(image, Executor(threads));
}

double distance(const std::uint8_t* a, const std::uint8_t* b) {
  double sum = 0;
  for (std::size_t i = 0; i < kSiftDescriptorBytes; ++i) sum += std::pow(int{a[i]} - int{b[i]}, 2);
  return std::sqrt(sum);
}

void expect_same(const Features& a, const Features& b) {
  ASSERT_EQ(a.keypoints.size(), b.keypoints.size());
  ASSERT_EQ(a.descriptors.count(), b.descriptors.count());
  if (a.keypoints.empty()) return;
  EXPECT_EQ(std::memcmp(a.keypoints.data(), b.keypoints.data(), a.keypoints.size() * sizeof(Keypoint)), 0);
  EXPECT_EQ(std::memcmp(a.descriptors.words(), b.descriptors.words(),
                        a.descriptors.count() * a.descriptors.stride()),
            0);
}

TEST(SiftExtrema, are_where_blobs_are_and_as_large) {
  const std::vector<Blob> blobs{{40.3, 50.6, 1.6, 90},
                                {100.75, 45.2, 2.5, -80},
                                {170.1, 60.9, 4, 70},
                                {60.4, 130.5, 6, -90},
                                {150.25, 140.75, 9, 80}};
  const GrayImage image = draw(220, 200, blobs);
  ScaleSpace space(image.width(), image.height(), 3);
  space.build(image, Executor());
  const std::vector<ScalePoint> points = find_sift_extrema(space, {}, Executor());
  for (const Blob& blob : blobs) {
    const auto error = [&](const ScalePoint& point) {
      const double pixel = ScaleSpace::pixel_size(point.octave);
      return std::hypot(static_cast<double>(point.x) * pixel - blob.u,
                        static_cast<double>(point.y) * pixel - blob.v);
    };
    const auto nearest = std::min_element(points.begin(), points.end(),
                                          [&](const auto& a, const auto& b) { return error(a) < error(b); });
    ASSERT_NE(nearest, points.end());
    EXPECT_LT(error(*nearest), 0.1) << blob.sigma;
    // G(k s) - G(s) of a blob of this sigma is extreme at s = sigma / sqrt(k), k = 2^(1/3).
    const double sigma =
        ScaleSpace::pixel_size(nearest->octave) * space.sigma(static_cast<double>(nearest->level) + 0.5);
    EXPECT_NEAR(sigma / blob.sigma, 1, 0.1);
  }
}

TEST(SiftExtrema, are_not_on_edges) {
  GrayImage image(120, 100, 60);
  for (int v = 0; v < 100; ++v)
    for (int u = 50; u < 120; ++u) image(u, v) = 190;
  EXPECT_TRUE(extract(image).keypoints.empty());
}

/// The feature of `features` at (u, v) within half a pixel whose angle and size are nearest, or none.
const Keypoint* at(const Features& features, double u, double v, double angle_deg, double size) {
  for (const Keypoint& keypoint : features.keypoints) {
    const double turn = std::abs(std::remainder(static_cast<double>(keypoint.angle_deg) - angle_deg, 360.0));
    if (std::hypot(static_cast<double>(keypoint.u) - u, static_cast<double>(keypoint.v) - v) < 0.1 &&
        turn < 2 && std::abs(static_cast<double>(keypoint.size) / size - 1) < 0.05)
      return &keypoint;
  }
  return nullptr;
}

TEST(Sift, a_quarter_turn_turns_the_keypoints) {
  constexpr int kSide = 257;  // of which the octaves of both images take the same pixels
  const GrayImage image = texture(kSide);
  GrayImage turned(kSide, kSide);
  for (int v = 0; v < kSide; ++v)
    for (int u = 0; u < kSide; ++u) turned(kSide - 1 - v, u) = image(u, v);
  const Features before = extract(image), after = extract(turned);
  ASSERT_GT(before.keypoints.size(), 50U);
  std::size_t found = 0, described = 0;
  for (std::size_t i = 0; i < before.keypoints.size(); ++i) {
    const Keypoint& k = before.keypoints[i];
    const Keypoint* twin = at(after, kSide - 1 - static_cast<double>(k.v), static_cast<double>(k.u),
                              static_cast<double>(k.angle_deg) + 90, static_cast<double>(k.size));
    if (twin == nullptr) continue;
    ++found;
    const auto j = static_cast<std::size_t>(twin - after.keypoints.data());
    if (distance(before.descriptors.row(i), after.descriptors.row(j)) < 60) ++described;
  }
  EXPECT_GE(found, before.keypoints.size() * 95 / 100);
  EXPECT_GE(described, found * 95 / 100);
}

/// How many of the mutual matches lie within a pixel of the map from one image of texture() to another.
double share_correct(const Features& a, const Features& b, double angle, double scale, std::size_t* matched) {
  constexpr double kCentre = (300 - 1) / 2.0;
  std::size_t correct = 0;
  const std::vector<Match> matches = match_mutual(a.descriptors, b.descriptors);
  for (const Match& match : matches) {
    const Keypoint& from = a.keypoints[static_cast<std::size_t>(match.query)];
    const Keypoint& to = b.keypoints[static_cast<std::size_t>(match.train)];
    const double x = static_cast<double>(from.u) - kCentre, y = static_cast<double>(from.v) - kCentre;
    const double u = kCentre + scale * (std::cos(angle) * x - std::sin(angle) * y);
    const double v = kCentre + scale * (std::sin(angle) * x + std::cos(angle) * y);
    if (std::hypot(static_cast<double>(to.u) - u, static_cast<double>(to.v) - v) < 1) ++correct;
  }
  *matched = matches.size();
  return static_cast<double>(correct) / static_cast<double>(matches.size());
}

TEST(Sift, matches_under_rotation_scale_and_contrast) {
  struct View {
    double angle_deg, scale, contrast;
  };
  const GrayImage image = texture(300);
  for (const bool root : {false, true}) {
    SiftOptions options;
    options.root = root;
    const Features first = extract(image, options);
    for (const View& view : {View{0, 1, 0.5}, {30, 1, 1}, {77, 1, 1}, {0, 0.8, 1}, {-45, 1.3, 0.7}}) {
      const double angle = view.angle_deg * std::numbers::pi / 180;
      const Features second = extract(texture(300, angle, view.scale, view.contrast), options);
      std::size_t matched = 0;
      const double share = share_correct(first, second, angle, view.scale, &matched);
      EXPECT_GT(share, 0.75) << view.angle_deg << ' ' << view.scale;
      EXPECT_GT(matched, first.keypoints.size() * 2 / 5) << view.angle_deg << ' ' << view.scale;
    }
  }
}

TEST(SiftDescriptor, hardly_changes_with_the_view) {
  const GrayImage image = texture(300);
  const double angle_deg = 50, angle = angle_deg * std::numbers::pi / 180, scale = 1.2;
  const GrayImage other = texture(300, angle, scale, 0.6);
  ScaleSpace first(300, 300, 3), second(300, 300, 3);
  first.build(image, Executor());
  second.build(other, Executor());
  ScalePoint point, seen;  // no extremum is needed: any place has a descriptor
  point.octave = 1, point.x = 150, point.y = 140, point.level = 1.2F;
  const double x = 150 - 149.5, y = 140 - 149.5;
  seen.octave = 1, seen.level = point.level + static_cast<float>(3 * std::log2(scale));
  seen.x = static_cast<float>(149.5 + scale * (std::cos(angle) * x - std::sin(angle) * y));
  seen.y = static_cast<float>(149.5 + scale * (std::sin(angle) * x + std::cos(angle) * y));
  std::array<std::uint8_t, kSiftDescriptorBytes> a{}, b{}, unturned{};
  describe_sift(first, point, 10, false, a.data());
  describe_sift(second, seen, 10 + static_cast<float>(angle_deg), false, b.data());
  describe_sift(second, seen, 10, false, unturned.data());
  EXPECT_LT(distance(a.data(), b.data()), 60);
  EXPECT_GT(distance(a.data(), unturned.data()), 200);
}

TEST(SiftOrientation, is_that_of_a_ramp) {
  for (const double angle_deg : {3.0, 95.0, 200.0, 355.0}) {
    const double angle = angle_deg * std::numbers::pi / 180;
    GrayImage image(100, 100);
    for (int v = 0; v < 100; ++v)
      for (int u = 0; u < 100; ++u)
        image(u, v) = static_cast<std::uint8_t>(
            std::lround(128 + 1.5 * ((u - 50) * std::cos(angle) + (v - 50) * std::sin(angle))));
    ScaleSpace space(100, 100, 3);
    space.build(image, Executor());
    ScalePoint point;
    point.x = 100, point.y = 100, point.level = 2;
    const std::vector<float> angles = sift_orientations(space, point);
    ASSERT_EQ(angles.size(), 1U);
    constexpr double kHalfBin = 5;  // all gradients are in the same one
    EXPECT_NEAR(std::remainder(static_cast<double>(angles[0]) - angle_deg, 360.0), 0, kHalfBin);
  }
}

TEST(Sift, keeps_the_strongest_but_leaves_no_part_of_the_image_out) {
  std::vector<Blob> blobs;  // strong ones left, weak ones right
  for (int row = 0; row < 10; ++row) {
    for (int column = 0; column < 10; ++column) {
      blobs.push_back({20.0 + 15 * column, 20.0 + 15 * row, 3, 100});
      blobs.push_back({220.0 + 15 * column, 20.0 + 15 * row, 3, 20});
    }
  }
  SiftOptions options;
  options.count = 60;
  const Features features = extract(draw(390, 180, blobs), options);
  ASSERT_EQ(features.keypoints.size(), 60U);
  const auto is_right = [](const Keypoint& keypoint) { return keypoint.u > 200; };
  const auto right = std::count_if(features.keypoints.begin(), features.keypoints.end(), is_right);
  EXPECT_GE(right, 5);
  EXPECT_LE(right, 30);
  EXPECT_TRUE(std::is_sorted(features.keypoints.begin(), features.keypoints.end(),
                             [](const Keypoint& a, const Keypoint& b) { return a.response > b.response; }));
}

TEST(Sift, gives_what_there_is_where_more_is_asked) {
  SiftOptions options;
  options.count = 1000000;
  const Features all = extract(texture(200), options);
  EXPECT_GT(all.keypoints.size(), 20U);
  EXPECT_EQ(all.descriptors.count(), all.keypoints.size());
  options.count = 1;
  EXPECT_EQ(extract(texture(200), options).keypoints.size(), 1U);
}

TEST(Sift, has_a_defined_result_for_any_image) {
  for (const auto& [width, height] :
       {std::pair{0, 0}, {1, 1}, {1, 300}, {300, 1}, {3, 2}, {8, 8}, {9, 33}, {17, 16}})
    EXPECT_TRUE(extract(GrayImage(width, height, 99)).keypoints.empty()) << width << ' ' << height;
  Random random(5);
  for (const auto& [width, height] : {std::pair{1, 1}, {2, 90}, {8, 8}, {9, 33}, {31, 17}, {64, 65}}) {
    GrayImage image(width, height);
    for (std::size_t i = 0; i < image.size(); ++i)
      image.data()[i] = static_cast<std::uint8_t>(random.index(256));
    const Features features = extract(image);
    EXPECT_EQ(features.keypoints.size(), features.descriptors.count());
    for (const Keypoint& keypoint : features.keypoints) {
      EXPECT_TRUE(keypoint.u > 0 && keypoint.u < static_cast<float>(width));
      EXPECT_TRUE(keypoint.v > 0 && keypoint.v < static_cast<float>(height));
      EXPECT_TRUE(keypoint.angle_deg >= 0 && keypoint.angle_deg < 360);
    }
  }
}

TEST(Sift, has_the_same_bits_at_any_number_of_threads) {
  const GrayImage image = texture(300);
  for (const int count : {40, 1000}) {
    SiftOptions options;
    options.count = count;
    const Features one = extract(image, options, 1);
    expect_same(one, extract(image, options, 2));
    expect_same(one, extract(image, options, 3));
  }
}

TEST(Sift, one_extractor_serves_several_threads_and_sizes) {
  const auto extractor = make_sift_extractor({});
  const std::vector<GrayImage> images{texture(200), texture(160), texture(200, 1.0), texture(160, 2.0)};
  const auto together =
      Executor(3).map<Features>(12, [&](std::size_t i) { return extractor->extract(images[i % 4]); });
  for (std::size_t i = 0; i < together.size(); ++i) expect_same(together[i], extract(images[i % 4]));
}

TEST(Sift, works_with_any_number_of_layers) {
  for (const int layers : {1, 2, 5}) {
    SiftOptions options;
    options.layers = layers;
    EXPECT_GT(extract(texture(200), options).keypoints.size(), 20U) << layers;
  }
}

TEST(SiftOptions, name_what_is_wrong) {
  SiftOptions options;
  options.layers = 0;
  EXPECT_THROW(options.validate(), InputError);
  options = {};
  options.extrema.contrast = 0;
  EXPECT_THROW(options.validate(), InputError);
  options = {};
  options.count = 0;
  EXPECT_THROW((void)make_sift_extractor(options), InputError);
}

}  // namespace
}  // namespace cairn
