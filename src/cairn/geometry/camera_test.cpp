// SPDX-License-Identifier: Apache-2.0
#include "cairn/geometry/camera.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <ostream>
#include <string>

#include "cairn/core/random.h"

namespace cairn {
namespace {

struct NamedCamera {
  std::string name;
  Camera camera;
};

/// For the names of the tests.
std::ostream& operator<<(std::ostream& stream, const NamedCamera& named) {
  return stream << named.name;
}

/// One of each model, mild and strong.
const NamedCamera kCameras[] = {
    {"pinhole", {CameraModel::pinhole, 640, 480, 525.0, 520.0, 319.5, 239.5, {}}},
    {"radtan_without_distortion", {CameraModel::radtan, 640, 480, 525.0, 520.0, 319.5, 239.5, {}}},
    {"radtan_kinect",  // TUM fr1
     {CameraModel::radtan, 640, 480, 517.3, 516.5, 318.6, 255.3, {0.2624, -0.9531, -0.0054, 0.0026, 1.1633}}},
    {"radtan_euroc",
     {CameraModel::radtan,
      752,
      480,
      458.654,
      457.296,
      367.215,
      248.375,
      {-0.28340811, 0.07395907, 0.00019359, 1.76e-5, 0}}},
    {"radtan_wide",
     {CameraModel::radtan, 640, 480, 320.0, 320.0, 320.0, 240.0, {-0.25, 0.04, 0.001, -0.001, 0}}},
    {"radtan_that_folds_beyond_50_degrees",
     {CameraModel::radtan, 640, 480, 560.0, 560.0, 320.0, 240.0, {-0.3, 0.03, 0, 0, 0}}},
    {"kb4_without_distortion", {CameraModel::kb4, 640, 480, 250.0, 250.0, 320.0, 240.0, {}}},
    {"kb4_that_folds_beyond_52_degrees",
     {CameraModel::kb4, 320, 240, 350.0, 350.0, 160.0, 120.0, {-0.4, 0, 0, 0}}},
    {"kb4_tumvi",
     {CameraModel::kb4,
      512,
      512,
      190.98,
      190.97,
      254.93,
      256.9,
      {0.0034823894, 0.0007150348, -0.0020532361, 0.0002029367}}},
};

class CameraTest : public testing::TestWithParam<NamedCamera> {
 protected:
  /// Calls check(pixel) for a grid over the image with its corners.
  template <class Check>
  void for_each_pixel(const Check& check) const {
    constexpr int kSteps = 24;
    for (int i = 0; i <= kSteps; ++i) {
      for (int j = 0; j <= kSteps; ++j)
        check(Eigen::Vector2d(i * (camera_.width - 1.0) / kSteps, j * (camera_.height - 1.0) / kSteps));
    }
  }

  const Camera& camera_ = GetParam().camera;
};

INSTANTIATE_TEST_SUITE_P(Models, CameraTest, testing::ValuesIn(kCameras),
                         [](const auto& instance) { return instance.param.name; });

/// A ray may be missing at the rim of a fisheye image, nowhere else.
TEST_P(CameraTest, projecting_a_pixels_ray_gives_the_pixel) {
  int missing = 0;
  for_each_pixel([&](const Eigen::Vector2d& pixel) {
    const auto point = camera_.back_project(pixel, 2.5);
    if (!point) {
      ++missing;
      return;
    }
    EXPECT_EQ(point->z(), 2.5);
    const auto again = camera_.project(*point);
    ASSERT_TRUE(again) << pixel.transpose();
    EXPECT_LT((*again - pixel).norm(), 1e-8) << pixel.transpose();
  });
  if (camera_.model != CameraModel::kb4) {
    EXPECT_EQ(missing, 0);
  }
}

/// Also for points far outside the field of view: where a strong distortion folds back, there is no pixel.
TEST_P(CameraTest, the_ray_of_a_projected_point_goes_through_the_point) {
  Random random(7);
  int seen = 0;
  for (int i = 0; i < 20'000; ++i) {
    const double z = random.uniform(0.1, 20.0);
    const Eigen::Vector3d point(z * random.uniform(-4, 4), z * random.uniform(-4, 4), z);
    const auto pixel = camera_.project(point);
    if (!pixel || !camera_.contains(*pixel)) continue;
    ++seen;
    const auto ray = camera_.unproject(*pixel);
    ASSERT_TRUE(ray) << point.transpose();
    EXPECT_LT((*ray * z - point.head<2>()).norm(), 1e-7 * point.norm()) << (point / z).transpose();
  }
  EXPECT_GT(seen, 300);
}

TEST_P(CameraTest, the_centre_looks_straight_ahead) {
  const auto pixel = camera_.project({0, 0, 3});
  ASSERT_TRUE(pixel);
  EXPECT_LT((*pixel - Eigen::Vector2d(camera_.cx, camera_.cy)).norm(), 1e-12);
  EXPECT_LT(camera_.unproject({camera_.cx, camera_.cy})->norm(), 1e-12);
}

TEST_P(CameraTest, the_scale_of_a_point_does_not_matter) {
  const Eigen::Vector3d point(0.2, -0.1, 1.0);
  EXPECT_LT((*camera_.project(point) - *camera_.project(7.0 * point)).norm(), 1e-10);
}

TEST_P(CameraTest, sees_nothing_behind_it) {
  EXPECT_FALSE(camera_.project({0.1, 0.1, -1}));
  EXPECT_FALSE(camera_.project({0, 0, 0}));
  EXPECT_FALSE(camera_.project({0, 0, std::numeric_limits<double>::quiet_NaN()}));
}

TEST_P(CameraTest, stands_points_without_measure) {
  const auto pixel = camera_.project({std::numeric_limits<double>::max(), 1, 1e-3});
  EXPECT_FALSE(pixel && camera_.contains(*pixel));
}

/// No fold within the image: right stays right, down stays down.
TEST_P(CameraTest, keeps_orientation_all_over_the_image) {
  for_each_pixel([&](const Eigen::Vector2d& pixel) {
    const auto here = camera_.unproject(pixel);
    const auto right = camera_.unproject(pixel + Eigen::Vector2d(1e-3, 0));
    const auto down = camera_.unproject(pixel + Eigen::Vector2d(0, 1e-3));
    if (!here || !right || !down) return;
    Eigen::Matrix2d turn;
    turn << *right - *here, *down - *here;
    EXPECT_GT(turn.determinant(), 0) << pixel.transpose();
  });
}

TEST_P(CameraTest, without_distortion_is_a_pinhole_of_the_same_focal_length) {
  const Camera plain = camera_.undistorted();
  EXPECT_EQ(plain.model, CameraModel::pinhole);
  EXPECT_EQ(plain.fx, camera_.fx);
  EXPECT_EQ(plain.distortion, (std::array<double, 5>{}));
  EXPECT_LT(
      (*plain.project({1, 2, 4}) - Eigen::Vector2d(plain.cx + plain.fx / 4, plain.cy + plain.fy / 2)).norm(),
      1e-12);
}

/// Values of the formulas in OpenCV's documentation, worked out apart from this code.
TEST(Camera, agrees_with_the_published_formulas) {
  const Eigen::Vector3d point(0.3, -0.2, 1.0);
  Camera camera{CameraModel::radtan, 640, 480, 500, 510, 320, 240, {-0.3, 0.1, 0.001, -0.002, 0.05}};
  const auto radtan = camera.project(point);
  EXPECT_NEAR(radtan->x(), 464.049977500000, 1e-9);
  EXPECT_NEAR(radtan->y(), 142.023915300000, 1e-9);
  camera.model = CameraModel::kb4;
  camera.distortion = {-0.01, 0.02, -0.003, 0.0004};
  const auto fisheye = camera.project(point);
  EXPECT_NEAR(fisheye->x(), 463.832388665406, 1e-9);
  EXPECT_NEAR(fisheye->y(), 142.193975707524, 1e-9);
}

TEST(Camera, contains_the_centres_of_its_pixels) {
  const Camera& camera = kCameras[0].camera;
  EXPECT_TRUE(camera.contains({0, 0}));
  EXPECT_TRUE(camera.contains({639, 479}));
  EXPECT_FALSE(camera.contains({-0.1, 0}));
  EXPECT_FALSE(camera.contains({639.1, 0}));
  EXPECT_FALSE(camera.contains({0, 480}));
}

TEST(Camera, models_have_the_names_of_the_files) {
  EXPECT_EQ(to_string(CameraModel::pinhole), "pinhole");
  EXPECT_EQ(to_string(CameraModel::radtan), "radtan");
  EXPECT_EQ(to_string(CameraModel::kb4), "kb4");
}

}  // namespace
}  // namespace cairn
