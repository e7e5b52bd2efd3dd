// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/landmark_picture.h"

#include <gtest/gtest.h>

#include <cmath>

#include "cairn/core/random.h"
#include "cairn/map_files/map_file.h"
#include "cairn/report/colors.h"
#include "cairn/testing/core/temporary_folder.h"
#include "cairn/testing/map_files/scene_map.h"

namespace cairn {
namespace {

using testkit::kSceneRig;
using testkit::observe_points;
using testkit::TemporaryFolder;

constexpr Rgb8 kStart{22, 163, 74}, kEnd{220, 38, 38}, kWeak{234, 88, 12}, kPale{148, 163, 184};

/// A way of `steps` metres along z through two walls of landmarks, 3 m to its left and right; in the world of
/// a SLAM run. `far` more landmarks lie a kilometre away.
Map alley(int steps, int far = 0) {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 400; ++i)
    points.emplace_back(i % 2 == 0 ? -3 : 3, -0.01 * (i % 50), 1 + 0.1 * steps * (i % 37) / 3.7);
  for (int i = 0; i < far; ++i) points.emplace_back(1000, 0, 1000);
  Map map(kSceneRig, "AKAZE");
  Random random(7);
  for (int k = 0; k <= steps; ++k) {
    const Rigid3 pose{Eigen::Quaterniond::Identity(), {0, 0, 1.0 * k}};
    ObservedFrame frame =
        observe_points(points, Rigid3{Eigen::Quaterniond::Identity(), {0, 0, -1}}, 61, random);
    frame.frame = {k};
    frame.stamp_ns = 1'000'000'000LL * (k + 1);
    map.add_keyframe(std::move(frame), pose, k == 0 ? KeyframeId{} : KeyframeId{k - 1}, 0);
  }
  for (std::size_t i = 0; i < points.size(); ++i)
    map.add_landmark(points[i], {{0}, static_cast<std::int32_t>(i)});
  return map;
}

/// Mean place and number of the pixels of a colour.
struct Pixels {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  int count = 0;
};

Pixels pixels_of(const RgbImage& picture, const Rgb8& color, int tolerance = 0) {
  Pixels found;
  for (int v = 0; v < picture.height(); ++v) {
    for (int u = 0; u < picture.width(); ++u) {
      const Rgb8& p = picture(u, v);
      if (std::abs(p.r - color.r) > tolerance || std::abs(p.g - color.g) > tolerance ||
          std::abs(p.b - color.b) > tolerance)
        continue;
      found.mean += Eigen::Vector2d(u, v);
      ++found.count;
    }
  }
  if (found.count > 0) found.mean /= found.count;
  return found;
}

RgbImage drawn(const Map& map, const std::vector<Eigen::Matrix3d>& covariances = {}) {
  const TemporaryFolder folder;
  write_map(folder.path() / "map", map, covariances);
  RgbImage picture = draw_landmarks(folder.path() / "map");
  EXPECT_EQ(picture, draw_landmarks(folder.path() / "map"));
  return picture;
}

TEST(LandmarkPicture, a_drive_ahead_goes_up_the_picture) {
  const RgbImage picture = drawn(alley(20));
  const Pixels start = pixels_of(picture, kStart), end = pixels_of(picture, kEnd);
  ASSERT_GT(start.count, 60);  // a dot and its name
  ASSERT_GT(end.count, 60);
  EXPECT_NEAR(start.mean.x(), end.mean.x(), 20);  // with their names
  EXPECT_GT(start.mean.y() - end.mean.y(), 0.7 * picture.height());
}

TEST(LandmarkPicture, landmarks_far_away_do_not_shrink_the_scene) {
  const RgbImage all = drawn(alley(20)), with_far = drawn(alley(20, 3));
  EXPECT_EQ(all.width(), with_far.width());
  EXPECT_NEAR(pixels_of(all, kEnd).mean.y(), pixels_of(with_far, kEnd).mean.y(), 3);
}

TEST(LandmarkPicture, uncertain_landmarks_do_not_widen_the_scene_unless_all_are) {
  Map map = alley(20);
  const auto covariances = [&](double near_std, double far_std) {
    std::vector<Eigen::Matrix3d> result;
    for (const Landmark& landmark : map.landmarks()) {
      const double std = landmark.id.value % 4 == 0 ? far_std : near_std;
      result.emplace_back(std * std * Eigen::Matrix3d::Identity());
    }
    return result;
  };
  for (const Landmark& landmark : map.landmarks())
    if (landmark.id.value % 4 == 0) map.move(landmark.id, {200, 0, 100});
  const int narrow = drawn(map, covariances(0.1, 5)).width();
  EXPECT_EQ(narrow, drawn(alley(20)).width());
  EXPECT_GT(drawn(map, covariances(5, 5)).width(), narrow);
  EXPECT_GT(drawn(map, covariances(0.1, 0.5)).width(), narrow);
}

TEST(LandmarkPicture, landmarks_have_the_colour_of_their_standard_deviation) {
  const Map map = alley(20);
  std::vector<Eigen::Matrix3d> covariances;
  for (const Landmark& landmark : map.landmarks()) {  // 1 cm on the left, 1 m on the right
    const double std = landmark.point_in_world.x() < 0 ? 0.01 : 1;
    covariances.emplace_back(std * std * Eigen::Matrix3d::Identity());
  }
  const RgbImage picture = drawn(map, covariances);
  const auto in_scene = [&](const Rgb8& color, bool left) {
    int count = 0;
    for (int v = 90; v < picture.height() - 90; ++v)
      for (int u = 0; u < picture.width(); ++u)
        if (const Rgb8& p = picture(u, v);
            std::abs(p.r - color.r) + std::abs(p.g - color.g) + std::abs(p.b - color.b) < 30)
          count += (u < picture.width() / 2) == left ? 1 : 0;
    return count;
  };
  EXPECT_GT(in_scene(error_rgb(0), true), 100);
  EXPECT_EQ(in_scene(error_rgb(0), false), 0);
  EXPECT_GT(in_scene(error_rgb(1), false), 100);
  EXPECT_EQ(in_scene(error_rgb(1), true), 0);
  EXPECT_GT(pixels_of(picture, error_rgb(0.5), 4).count, 12);    // the legend has all of them
  EXPECT_EQ(pixels_of(drawn(map), error_rgb(0.5), 4).count, 0);  // and none if none was computed
}

/// The drawing without what is written above and below it.
int unknown_in_scene(const Map& map) {
  const RgbImage picture = drawn(map);
  int count = 0;
  for (int v = 90; v < picture.height() - 90; ++v)
    for (int u = 0; u < picture.width(); ++u) count += std::abs(picture(u, v).g - kUnknownStd.g) < 40 ? 1 : 0;
  return count;
}

TEST(LandmarkPicture, draws_the_component_with_most_keyframes_alone) {
  Map map = alley(20);
  const int alone = unknown_in_scene(map);
  Random random(3);
  ObservedFrame frame = observe_points({{0, 0, 5}}, {}, 61, random);
  frame.stamp_ns = 99'000'000'000;
  frame.frame = {40};
  const KeyframeId other = map.add_keyframe(std::move(frame), {}, {}, 1);
  map.add_landmark({1.5, 0, 10}, {other, 0});  // where the alley has none
  EXPECT_EQ(unknown_in_scene(map), alone);
  map.set_component(other, 0);
  EXPECT_NE(unknown_in_scene(map), alone);
}

TEST(LandmarkPicture, a_map_of_one_keyframe_without_landmarks_has_a_picture) {
  Map map(kSceneRig, "AKAZE");
  Random random(3);
  map.add_keyframe(observe_points({{0, 0, 5}}, {}, 61, random), {}, {}, 0);
  const RgbImage picture = drawn(map);
  EXPECT_GT(pixels_of(picture, kStart).count, 60);
}

TEST(FoundPosesPicture, marks_poses_by_their_verdict) {
  const TemporaryFolder folder;
  write_map(folder.path() / "map", alley(20));
  const auto at = [](double x, double z) {
    return WorldFromCamera(Rigid3{Eigen::Quaterniond::Identity(), {x, 0, z}});
  };
  const std::vector<FoundPose> found{
      {at(-1, 2), true}, {at(-1, 15), true}, {at(1, 10), false}, {at(900, 0), false}};
  const RgbImage picture = draw_found_poses(folder.path() / "map", found, 3);
  const RgbImage none = draw_found_poses(folder.path() / "map", {}, 3);
  EXPECT_EQ(picture.width(), none.width());  // the weak one far away has no influence
  const int good = pixels_of(picture, kStart).count - pixels_of(none, kStart).count;
  const int weak = pixels_of(picture, kWeak).count - pixels_of(none, kWeak).count;
  EXPECT_GT(weak, 40);
  EXPECT_NEAR(good, 2.0 * weak, 0.3 * good);
  EXPECT_GT(pixels_of(none, kPale, 40).count, 400);
}

}  // namespace
}  // namespace cairn
