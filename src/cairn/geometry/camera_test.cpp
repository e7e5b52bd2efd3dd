// SPDX-License-Identifier: Apache-2.0
#include "cairn/geometry/camera.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>
#include <string>
#include <vector>

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

/// Lenses as they are made: between a narrow and a wide view, up to the strongest barrel that is sold.
Camera random_camera(CameraModel model, Random& random) {
  Camera camera{model, 640, 480, 0, 0, random.uniform(300, 340), random.uniform(220, 260), {}};
  camera.fx = random.uniform(250, 900);
  camera.fy = camera.fx * random.uniform(0.97, 1.03);
  if (model == CameraModel::radtan) {
    camera.distortion = {random.uniform(-0.35, 0.15), random.uniform(-0.1, 0.15), random.uniform(-2e-3, 2e-3),
                         random.uniform(-2e-3, 2e-3), random.uniform(-0.02, 0.02)};
  } else if (model == CameraModel::kb4) {
    camera.distortion = {random.uniform(-0.06, 0.06), random.uniform(-0.03, 0.03),
                         random.uniform(-0.02, 0.02), random.uniform(-5e-3, 5e-3), 0};
  }
  return camera;
}

std::vector<NamedCamera> all_cameras() {
  std::vector<NamedCamera> cameras(std::begin(kCameras), std::end(kCameras));
  Random random(41);
  for (const CameraModel model : {CameraModel::pinhole, CameraModel::radtan, CameraModel::kb4}) {
    for (int i = 0; i < 12; ++i) {
      cameras.push_back(
          {std::string(to_string(model)) + "_random_" + std::to_string(i), random_camera(model, random)});
    }
  }
  return cameras;
}

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

  /// Calls check(point) for points in front of the camera that it sees.
  template <class Check>
  void for_each_point(const Check& check) const {
    Random random(11);
    int seen = 0;
    for (int i = 0; i < 1000; ++i) {
      const double z = random.uniform(0.3, 20.0);
      const Eigen::Vector3d point(z * random.uniform(-1.5, 1.5), z * random.uniform(-1.5, 1.5), z);
      const auto pixel = camera_.project(point);
      if (!pixel || !camera_.contains(*pixel)) continue;
      ++seen;
      check(point);
    }
    EXPECT_GT(seen, 20);
  }

  const Camera& camera_ = GetParam().camera;
};

/// By central differences of `value`, whose arguments are moved one after the other by `step`.
template <int Rows, int Columns, class Value>
Eigen::Matrix<double, Rows, Columns> differences(const Eigen::Matrix<double, Columns, 1>& at,
                                                 const Eigen::Matrix<double, Columns, 1>& step,
                                                 const Value& value) {
  Eigen::Matrix<double, Rows, Columns> slopes;
  for (int i = 0; i < Columns; ++i) {
    Eigen::Matrix<double, Columns, 1> above = at, below = at;
    above[i] += step[i];
    below[i] -= step[i];
    slopes.col(i) = (value(above) - value(below)) / (above[i] - below[i]);
  }
  return slopes;
}

INSTANTIATE_TEST_SUITE_P(Models, CameraTest, testing::ValuesIn(all_cameras()),
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
  EXPECT_LE(missing, camera_.model == CameraModel::kb4 ? 300 : 0);  // of 625
}

/// Also for points far outside the field of view: where a strong distortion folds back, there is no pixel.
TEST_P(CameraTest, the_ray_of_a_projected_point_goes_through_the_point) {
  Random random(7);
  int seen = 0;
  for (int i = 0; i < 60'000; ++i) {
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

TEST_P(CameraTest, what_is_no_number_is_seen_nowhere) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    for (int i = 0; i < 3; ++i) {
      Eigen::Vector3d point(0.1, 0.2, 1.0);
      point[i] = bad;
      if (i < 2) {  // infinitely far ahead is straight ahead
        EXPECT_FALSE(camera_.project(point)) << point.transpose();
        EXPECT_FALSE(camera_.project_with_jacobians(point)) << point.transpose();
      }
    }
    EXPECT_FALSE(camera_.unproject({bad, 10}));
    EXPECT_FALSE(camera_.unproject({10, bad}));
    EXPECT_FALSE(camera_.unproject_with_jacobian({bad, 10}));
  }
}

/// Pixels far outside the image, too: a ray comes back to its pixel, or there is none.
TEST_P(CameraTest, what_is_unprojected_is_projected_back_everywhere) {
  Random random(3);
  int seen = 0;
  for (int i = 0; i < 3000; ++i) {
    const Eigen::Vector2d pixel(random.uniform(-2000, 3000), random.uniform(-2000, 3000));
    const auto ray = camera_.unproject(pixel);
    if (!ray) continue;
    ++seen;
    const auto again = camera_.project(ray->homogeneous());
    ASSERT_TRUE(again) << pixel.transpose();
    EXPECT_LT((*again - pixel).norm(), 1e-6) << pixel.transpose();
  }
  EXPECT_GT(seen, 10);
}

TEST_P(CameraTest, derivatives_of_the_projection_by_the_point) {
  for_each_point([&](const Eigen::Vector3d& point) {
    const auto projected = camera_.project_with_jacobians(point);
    ASSERT_TRUE(projected);
    EXPECT_EQ(projected->pixel, *camera_.project(point));
    const Eigen::Vector3d step = Eigen::Vector3d::Constant(1e-6 * point.z());
    const auto numeric =
        differences<2, 3>(point, step, [&](const Eigen::Vector3d& at) { return *camera_.project(at); });
    EXPECT_LT((projected->by_point - numeric).norm(), 1e-6 * numeric.norm()) << point.transpose();
  });
}

TEST_P(CameraTest, derivatives_of_the_projection_by_the_intrinsics) {
  using Intrinsics = Eigen::Matrix<double, 9, 1>;
  Intrinsics given;
  given << camera_.fx, camera_.fy, camera_.cx, camera_.cy,
      Eigen::Map<const Eigen::Matrix<double, 5, 1>>(camera_.distortion.data());
  for_each_point([&](const Eigen::Vector3d& point) {
    const auto project_with = [&](const Intrinsics& i) {
      Camera camera{camera_.model, camera_.width, camera_.height, i[0], i[1], i[2], i[3], {}};
      std::copy(i.data() + 4, i.data() + 9, camera.distortion.begin());
      return *camera.project(point);
    };
    Intrinsics step = Intrinsics::Constant(1e-7);
    step.head<4>().setConstant(1e-3);
    const auto numeric = differences<2, 9>(given, step, project_with);
    const auto analytic = camera_.project_with_jacobians(point)->by_intrinsics;
    EXPECT_LT((analytic - numeric).cwiseAbs().maxCoeff(), 1e-5 * (1 + numeric.norm())) << point.transpose();
  });
}

TEST_P(CameraTest, derivatives_of_the_ray_by_the_pixel) {
  int steep = 0, even = 0;
  for_each_point([&](const Eigen::Vector3d& point) {
    const Eigen::Vector2d pixel = *camera_.project(point);
    const auto unprojected = camera_.unproject_with_jacobian(pixel);
    ASSERT_TRUE(unprojected);
    EXPECT_EQ(unprojected->ray, *camera_.unproject(pixel));
    const Eigen::Matrix2d by_plane =
        camera_.project_with_jacobians(unprojected->ray.homogeneous())->by_point.leftCols<2>();
    EXPECT_LT((unprojected->by_pixel * by_plane - Eigen::Matrix2d::Identity()).norm(), 1e-9);
    const Eigen::Vector2d step = Eigen::Vector2d::Constant(1e-3);
    const auto numeric =
        differences<2, 2>(pixel, step, [&](const Eigen::Vector2d& at) { return *camera_.unproject(at); });
    if (by_plane.determinant() <= 1e-2 * camera_.fx * camera_.fy) {  // near the fold
      ++steep;
      return;
    }
    ++even;
    EXPECT_LT((unprojected->by_pixel - numeric).norm(), 1e-4 * numeric.norm()) << pixel.transpose();
  });
  EXPECT_GT(even, 10 * steep);
}

/// No fold within the image: right stays right, down stays down.
TEST_P(CameraTest, keeps_orientation_all_over_the_image) {
  int shown = 0;
  for_each_pixel([&](const Eigen::Vector2d& pixel) {
    const auto here = camera_.unproject(pixel);
    const auto right = camera_.unproject(pixel + Eigen::Vector2d(1e-3, 0));
    const auto down = camera_.unproject(pixel + Eigen::Vector2d(0, 1e-3));
    if (!here || !right || !down) return;
    ++shown;
    Eigen::Matrix2d turn;
    turn << *right - *here, *down - *here;
    EXPECT_GT(turn.determinant(), 0) << pixel.transpose();
  });
  EXPECT_GE(shown, 300);  // of 625
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
