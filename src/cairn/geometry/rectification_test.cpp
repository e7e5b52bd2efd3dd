// SPDX-License-Identifier: Apache-2.0
#include "cairn/geometry/rectification.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "cairn/core/random.h"

namespace cairn {
namespace {

const Camera kPinhole{CameraModel::pinhole, 640, 480, 525.0, 520.0, 322.0, 237.5, {}};
const Camera kRadtan{CameraModel::radtan,
                     752,
                     480,
                     458.654,
                     457.296,
                     367.215,
                     248.375,
                     {-0.28340811, 0.07395907, 0.00019359, 1.76e-5, 0}};
const Camera kFisheye{
    CameraModel::kb4, 512,    512,   190.98,
    190.97,           254.93, 256.9, {0.0034823894, 0.0007150348, -0.0020532361, 0.0002029367}};

struct NamedPair {
  std::string name;
  StereoPair pair;
};

std::ostream& operator<<(std::ostream& stream, const NamedPair& named) {
  return stream << named.name;
}

LeftFromRight right_camera(const Eigen::Vector3d& rotation_vector, const Eigen::Vector3d& translation) {
  return LeftFromRight({rotation_exp(rotation_vector), translation});
}

std::vector<NamedPair> all_pairs() {
  std::vector<NamedPair> pairs;
  Random random(5);
  for (const Camera& left : {kPinhole, kRadtan, kFisheye}) {
    for (const Camera& right : {kPinhole, kRadtan, kFisheye}) {
      const auto small = [&](double limit) {
        return Eigen::Vector3d(random.uniform(-limit, limit), random.uniform(-limit, limit),
                               random.uniform(-limit, limit));
      };
      const LeftFromRight left_from_right =
          right_camera(small(0.1), Eigen::Vector3d(0.2, 0, 0) + small(0.02));
      pairs.push_back({std::string(to_string(left.model)) + "_and_" + std::string(to_string(right.model)),
                       {left, right, left_from_right}});
    }
  }
  pairs.push_back({"cameras_that_look_inwards", {kRadtan, kRadtan, right_camera({0, -0.3, 0}, {0.5, 0, 0})}});
  pairs.push_back(
      {"cameras_that_look_outwards", {kFisheye, kFisheye, right_camera({0, 0.5, 0}, {0.1, 0, 0})}});
  pairs.push_back({"right_camera_upside_down", {kRadtan, kRadtan, right_camera({0, 0, 3.1}, {0.1, 0, 0})}});
  pairs.push_back(
      {"right_camera_below", {kRadtan, kPinhole, right_camera({0.02, 0, 0.03}, {0.01, 0.12, 0})}});
  pairs.push_back({"right_camera_above", {kPinhole, kPinhole, right_camera({0, 0, 0}, {0.01, -0.12, 0})}});
  return pairs;
}

class RectificationTest : public testing::TestWithParam<NamedPair> {
 protected:
  const StereoPair& pair_ = GetParam().pair;
  const StereoRectification rectified_ = rectify_stereo(pair_);
};

INSTANTIATE_TEST_SUITE_P(Pairs, RectificationTest, testing::ValuesIn(all_pairs()),
                         [](const auto& instance) { return instance.param.name; });

/// Pixel of the rectified camera for what a raw camera sees at a pixel.
std::optional<Eigen::Vector2d> rectified_pixel(const Camera& raw, const Eigen::Vector2d& pixel,
                                               const Eigen::Quaterniond& rectified_from_raw,
                                               const Camera& rectified) {
  const auto ray = raw.unproject(pixel);
  if (!ray) return std::nullopt;
  return rectified.project(rectified_from_raw * ray->homogeneous());
}

TEST_P(RectificationTest, points_have_one_row_and_the_disparity_of_their_depth) {
  ASSERT_EQ(rectified_.status, RectificationStatus::ok);
  Random random(9);
  int seen = 0;
  for (int i = 0; i < 5000; ++i) {
    const double z = random.uniform(0.5, 20);
    const Eigen::Vector3d in_rectified(z * random.uniform(-2, 2), z * random.uniform(-2, 2), z);
    const Eigen::Vector3d in_left = rectified_.rectified_from_left.conjugate() * in_rectified;
    const auto left = pair_.left.project(in_left);
    const auto right = pair_.right.project(pair_.left_from_right.inverse() * in_left);
    if (!left || !right || !pair_.left.contains(*left) || !pair_.right.contains(*right)) continue;
    const Camera& camera = rectified_.camera;
    const auto l = rectified_pixel(pair_.left, *left, rectified_.rectified_from_left, camera);
    const auto r = rectified_pixel(pair_.right, *right, rectified_.rectified_from_right, camera);
    ASSERT_TRUE(l && r);
    ++seen;
    EXPECT_NEAR(l->y(), r->y(), 1e-7);
    EXPECT_NEAR(l->x() - r->x(), camera.fx * rectified_.baseline / z, 1e-7);
    EXPECT_LT((*l - *camera.project(in_rectified)).norm(), 1e-7);
  }
  EXPECT_GT(seen, 50);
}

/// An image spans half a pixel more than the centres of its pixels.
bool shows(const Camera& camera, const std::optional<Eigen::Vector2d>& pixel) {
  return pixel && pixel->x() >= -0.5 && pixel->y() >= -0.5 && pixel->x() <= camera.width - 0.5 &&
         pixel->y() <= camera.height - 0.5;
}

TEST_P(RectificationTest, every_pixel_is_seen_by_both_raw_cameras) {
  const Camera& camera = rectified_.camera;
  for (int v = 0; v < camera.height; v += 3) {
    for (int u = 0; u < camera.width; u += 3) {
      const Eigen::Vector3d ray = camera.unproject(Eigen::Vector2d(u, v))->homogeneous();
      const auto left = pair_.left.project(rectified_.rectified_from_left.conjugate() * ray);
      const auto right = pair_.right.project(rectified_.rectified_from_right.conjugate() * ray);
      ASSERT_TRUE(shows(pair_.left, left)) << u << ' ' << v;
      ASSERT_TRUE(shows(pair_.right, right)) << u << ' ' << v;
    }
  }
}

/// No other turn about the baseline brings the axis nearer to both optical axes.
TEST_P(RectificationTest, turns_the_cameras_as_little_as_it_can) {
  const Eigen::Vector3d left_axis = rectified_.rectified_from_left * Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d right_axis = rectified_.rectified_from_right * Eigen::Vector3d::UnitZ();
  const double nearness = left_axis.z() + right_axis.z();
  for (const double angle : {-0.5, -0.01, 0.01, 0.5}) {
    const Eigen::Vector3d turned = rotation_exp({angle, 0, 0}) * Eigen::Vector3d::UnitZ();
    EXPECT_LT(turned.dot(left_axis) + turned.dot(right_axis), nearness);
  }
}

TEST_P(RectificationTest, keeps_the_resolution_of_the_middle) {
  EXPECT_EQ(rectified_.camera.fx, rectified_.camera.fy);
  EXPECT_GE(rectified_.camera.fx, 0.79 * std::min(pair_.left.fx, pair_.right.fx));
}

TEST(Rectification, leaves_a_rectified_pair_as_it_is) {
  const Camera square{CameraModel::pinhole, 640, 480, 525, 525, 310, 250, {}};
  const auto rectified = rectify_stereo({square, square, right_camera({0, 0, 0}, {0.1, 0, 0})});
  ASSERT_EQ(rectified.status, RectificationStatus::ok);
  EXPECT_NEAR(rectified.camera.fx, 525, 1e-6);
  EXPECT_NEAR(rectified.camera.cx, 310, 1e-6);
  EXPECT_NEAR(rectified.camera.cy, 250, 1e-6);
  EXPECT_EQ(rectified.camera.width, 640);
  EXPECT_DOUBLE_EQ(rectified.baseline, 0.1);
  EXPECT_LT(rotation_angle(rectified.rectified_from_left), 1e-12);
}

TEST(Rectification, of_a_vertical_pair_lies_on_its_side) {
  const auto rectified = rectify_stereo({kPinhole, kPinhole, right_camera({0, 0, 0}, {0, 0.1, 0})});
  ASSERT_EQ(rectified.status, RectificationStatus::ok);
  EXPECT_EQ(rectified.camera.width, 480);
  EXPECT_EQ(rectified.camera.height, 640);
}

TEST(Rectification, pairs_that_are_none) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const auto status = [](const Eigen::Vector3d& rotation, const Eigen::Vector3d& translation) {
    return rectify_stereo({kPinhole, kPinhole, right_camera(rotation, translation)}).status;
  };
  EXPECT_EQ(status({0, 0, 0}, {0, 0, 0}), RectificationStatus::no_baseline);
  EXPECT_EQ(status({0, 0, 0}, {1e-9, 0, 0}), RectificationStatus::no_baseline);
  EXPECT_EQ(status({0, 0, 0}, {none, 0, 0}), RectificationStatus::no_baseline);
  EXPECT_EQ(status({0, 0, 0}, {1e200, 1e200, 0}), RectificationStatus::no_baseline);
  EXPECT_EQ(status({0, 0, 0}, {-0.1, 0, 0}), RectificationStatus::right_is_left);
  EXPECT_EQ(status({0, 0, 0}, {0, 0, 0.1}), RectificationStatus::no_common_view);
  EXPECT_EQ(status({none, 0, 0}, {0.1, 0, 0}), RectificationStatus::no_common_view);
  EXPECT_EQ(status({0, 3.1, 0}, {0.1, 0, 0}), RectificationStatus::no_common_view);
  EXPECT_EQ(status({0, 1.5, 0}, {0.1, 0, 0}), RectificationStatus::no_common_view);
}

}  // namespace
}  // namespace cairn
