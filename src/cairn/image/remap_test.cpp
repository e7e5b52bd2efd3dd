// SPDX-License-Identifier: Apache-2.0
#include "cairn/image/remap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cairn/core/error.h"
#include "cairn/geometry/rigid3.h"

namespace cairn {
namespace {

const Camera kPlain{CameraModel::pinhole, 160, 120, 140, 140, 79.5, 59.5, {}};
const Camera kRadtan{CameraModel::radtan, 160, 120, 120, 118, 81, 58, {-0.28, 0.07, 2e-4, 1e-5, 0}};
const Camera kFisheye{CameraModel::kb4, 160, 120, 70, 70, 80, 60, {0.003, 0.0007, -0.002, 0.0002, 0}};

/// Light from a direction of length 1: smooth, so that interpolation is nearly exact.
double light_from(const Eigen::Vector3d& direction) {
  return 128 + 50 * std::sin(7 * direction.x() + 1) + 45 * std::cos(6 * direction.y() - 2 * direction.x());
}

/// What a camera sees of that light; black where it has no ray.
GrayImage taken_by(const Camera& camera, const Eigen::Quaterniond& world_from_camera) {
  GrayImage image(camera.width, camera.height);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const auto ray = camera.unproject(Eigen::Vector2d(u, v));
      if (!ray) continue;
      const Eigen::Vector3d direction = world_from_camera * ray->homogeneous();
      image(u, v) = static_cast<std::uint8_t>(std::lround(light_from(direction.normalized())));
    }
  }
  return image;
}

const Eigen::Quaterniond kStraight = Eigen::Quaterniond::Identity();

/// Largest difference where the source sees anything, and how many pixels that are.
struct Comparison {
  int difference = 0;
  int pixels = 0;
};

Comparison compare(const ImageRemap& remap, const GrayImage& found, const GrayImage& wanted) {
  Comparison comparison;
  for (int v = 0; v < found.height(); ++v) {
    for (int u = 0; u < found.width(); ++u) {
      if (!remap.sees(u, v)) {
        EXPECT_EQ(found(u, v), 0);
        continue;
      }
      ++comparison.pixels;
      comparison.difference = std::max(comparison.difference, std::abs(found(u, v) - wanted(u, v)));
    }
  }
  return comparison;
}

ImageRemap undistortion(const Camera& camera, const Executor& executor = Executor()) {
  return {camera, camera.undistorted(), kStraight, executor};
}

TEST(ImageRemap, shows_what_the_target_would_have_seen) {
  const Eigen::Quaterniond source_from_target = rotation_exp({0.02, -0.05, 0.1});
  for (const Camera& source : {kPlain, kRadtan, kFisheye}) {
    for (const Camera& target : {kPlain, kRadtan, kFisheye}) {
      const ImageRemap remap(source, target, source_from_target);
      const auto found = remap(taken_by(source, kStraight));
      const Comparison compared = compare(remap, found, taken_by(target, source_from_target));
      EXPECT_LE(compared.difference, 2) << to_string(source.model) << " to " << to_string(target.model);
      EXPECT_GT(compared.pixels, 3000) << to_string(source.model) << " to " << to_string(target.model);
    }
  }
}

TEST(ImageRemap, undistorts) {
  for (const Camera& camera : {kPlain, kRadtan, kFisheye}) {
    const ImageRemap remap = undistortion(camera);
    const auto found = remap(taken_by(camera, kStraight));
    EXPECT_LE(compare(remap, found, taken_by(camera.undistorted(), kStraight)).difference, 2);
  }
}

TEST(ImageRemap, of_a_camera_to_itself_changes_nothing) {
  for (const Camera& camera : {kPlain, kRadtan}) {
    const GrayImage image = taken_by(camera, kStraight);
    EXPECT_EQ(ImageRemap(camera, camera, kStraight)(image), image);
  }
}

TEST(ImageRemap, moves_an_image_by_half_a_pixel) {
  const Camera source{CameraModel::pinhole, 4, 1, 10, 10, 1, 0, {}};
  Camera target = source;
  target.cx = 0.5;  // a thing seen at u is now at u - 0.5
  GrayImage image(4, 1);
  for (int u = 0; u < 4; ++u) image(u, 0) = static_cast<std::uint8_t>(10 * u);
  const GrayImage moved = ImageRemap(source, target, kStraight)(image);
  EXPECT_EQ(moved(0, 0), 5);
  EXPECT_EQ(moved(2, 0), 25);
  EXPECT_EQ(moved(3, 0), 30);  // half a pixel beyond the last centre: its value
  target.cx = 0.3;
  EXPECT_FALSE(ImageRemap(source, target, kStraight).sees(3, 0));
}

TEST(ImageRemap, of_colour_is_that_of_its_channels) {
  const GrayImage gray = taken_by(kRadtan, kStraight);
  RgbImage color(gray.width(), gray.height());
  for (std::size_t i = 0; i < gray.size(); ++i) {
    const std::uint8_t level = gray.data()[i];
    color.data()[i] = {level, static_cast<std::uint8_t>(255 - level), static_cast<std::uint8_t>(level / 2)};
  }
  const ImageRemap remap = undistortion(kRadtan);
  const GrayImage gray_moved = remap(gray);
  const RgbImage color_moved = remap(color);
  for (std::size_t i = 0; i < gray_moved.size(); ++i)
    EXPECT_EQ(color_moved.data()[i].r, gray_moved.data()[i]);
}

TEST(ImageRemap, has_the_same_bits_at_any_number_of_threads) {
  const GrayImage image = taken_by(kRadtan, kStraight);
  const Executor many(3);
  EXPECT_EQ(undistortion(kRadtan)(image), undistortion(kRadtan, many)(image, many));
}

TEST(ImageRemap, keeps_within_images_of_one_pixel) {
  for (const auto& [width, height] : {std::pair(1, 1), std::pair(1, 5), std::pair(5, 1)}) {
    const Camera camera{CameraModel::pinhole, width, height, 3, 3, 0.5 * (width - 1), 0.5 * (height - 1), {}};
    const GrayImage image(width, height, 77);
    EXPECT_EQ(ImageRemap(camera, camera, kStraight)(image), image);
  }
}

TEST(ImageRemap, is_black_where_the_source_looks_elsewhere) {
  const ImageRemap remap(kPlain, kPlain, rotation_exp({0, std::numbers::pi, 0}));
  EXPECT_EQ(remap(GrayImage(160, 120, 200)), GrayImage(160, 120, 0));
}

TEST(ImageRemap, refuses_images_of_another_size) {
  EXPECT_THROW((void)undistortion(kPlain)(GrayImage(161, 120)), PreconditionError);
}

}  // namespace
}  // namespace cairn
