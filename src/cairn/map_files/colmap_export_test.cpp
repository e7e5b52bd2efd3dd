// SPDX-License-Identifier: Apache-2.0
#include "cairn/map_files/colmap_export.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <vector>

#include "cairn/core/error.h"
#include "cairn/core/executor.h"
#include "cairn/core/progress.h"
#include "cairn/core/random.h"
#include "cairn/image/codec.h"
#include "cairn/map_files/colmap_sources.h"
#include "cairn/map_files/map_file.h"
#include "cairn/sequence/sequence.h"
#include "cairn/testing/core/temporary_folder.h"
#include "cairn/testing/map_files/colmap_model.h"
#include "cairn/testing/map_files/scene_map.h"

namespace cairn {
namespace {

using testkit::contents_of;
using testkit::kSceneRig;
using testkit::Model;
using testkit::ModelCamera;
using testkit::ModelImage;
using testkit::ModelPoint;
using testkit::observe_points;
using testkit::project;
using testkit::read_binary_model;
using testkit::read_text_model;
using testkit::scene_map;
using testkit::TemporaryFolder;

namespace fs = std::filesystem;

/// An image whose colours say where they are.
RgbImage pattern(int width, int height) {
  RgbImage image(width, height);
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u)
      image(u, v) = {static_cast<std::uint8_t>(255 * u / width), static_cast<std::uint8_t>(255 * v / height),
                     77};
  return image;
}

Camera scene_camera() {
  Camera camera;
  camera.width = 640, camera.height = 480;
  camera.fx = kSceneRig.fx, camera.fy = kSceneRig.fy, camera.cx = kSceneRig.cx, camera.cy = kSceneRig.cy;
  return camera;
}

/// A map and the sequence that it is of, with the images of its keyframes on disk.
class ColmapExport : public testing::Test {
 protected:
  void SetUp() override {
    sequence_.folder = folder_.path() / "seq";
    sequence_.calibration.camera = scene_camera();
    sequence_.calibration.baseline = kSceneRig.baseline;
    for (std::int64_t i = 0; i <= 40; ++i) {
      const std::string name = std::to_string(100 + i) + ".png";
      FrameFiles files{1'305'031'453'359'684'000 + 10'000'000 * i, i, sequence_.folder / "image_0" / name, {},
                       sequence_.folder / "image_1" / name,        i};
      if (i % 10 == 0) files.stamp_ns = 1'305'031'453'359'684'000 + 100'000'001 * (i / 10);
      sequence_.frames.push_back(files);
    }
  }

  /// The scene in one world; three keyframes of five are left of the first recording's.
  static Map one_world() {
    Map map = scene_map();
    map.set_component({3}, 0);
    map.set_component({4}, 0);
    return map;
  }

  void write_images(const RgbImage& image) const {
    fs::create_directories(sequence_.folder / "image_0");
    for (const int frame : {0, 10, 30, 40})
      write_png(sequence_.frames[static_cast<std::size_t>(frame)].color, image);
  }

  /// The model, which has the same values in both forms.
  Model exported(const Map& map, int threads = 1) {
    write_map(folder_.path() / "map", map);
    Progress silent;
    write_colmap_model(folder_.path() / "map", sequence_, model_, Executor(threads), silent);
    Model model = read_text_model(model_);
    EXPECT_EQ(model, read_binary_model(model_));
    return model;
  }

  /// Tracks lead to pixels that show the point, and pixels to points whose tracks have them.
  static void expect_linked(const Model& model) {
    std::size_t of_tracks = 0, of_images = 0;
    for (const ModelPoint& point : model.points) {
      double sum = 0;
      for (std::size_t k = 0; k < point.track.size(); k += 2) {
        const ModelImage& image = model.images.at(point.track[k] - 1);
        EXPECT_EQ(image.number, point.track[k]);
        EXPECT_EQ(image.points.at(point.track[k + 1]), static_cast<std::int64_t>(point.number));
        const ModelCamera& camera = model.cameras.at(image.camera - 1);
        sum += (project(camera, image.camera_from_world() * point.point_in_world()) -
                image.pixel(point.track[k + 1]))
                   .norm();
      }
      const double count = static_cast<double>(point.track.size()) / 2;
      EXPECT_NEAR(point.error, sum / count, 5e-4);
      of_tracks += point.track.size() / 2;
    }
    for (const ModelImage& image : model.images)
      for (const std::int64_t point : image.points) of_images += point > 0 ? 1 : 0;
    EXPECT_EQ(of_tracks, of_images);
    EXPECT_GT(of_tracks, 0U);
  }

  TemporaryFolder folder_;
  fs::path model_ = folder_.path() / "model";
  Sequence sequence_;
};

TEST_F(ColmapExport, both_cameras_of_a_pair_show_the_landmarks) {
  const Map map = one_world();
  write_images(pattern(640, 480));
  const Model model = exported(map);
  ASSERT_EQ(model.cameras.size(), 2U);
  ASSERT_EQ(model.images.size(), 8U);
  ASSERT_EQ(model.points.size(), 8U);
  expect_linked(model);
  for (const ModelPoint& point : model.points) {
    EXPECT_GT(point.error, 0.01);  // of noise; a pixel's half that was forgotten would add to it
    EXPECT_LT(point.error, 12);
  }
  for (std::size_t i = 0; i < 4; ++i) {
    const ModelImage &left = model.images[2 * i], &right = model.images[2 * i + 1];
    EXPECT_EQ(left.camera, 1U);
    EXPECT_EQ(right.camera, 2U);
    const Rigid3 right_from_left = right.camera_from_world() * left.camera_from_world().inverse();
    EXPECT_LT((right_from_left.translation - Eigen::Vector3d(-kSceneRig.baseline, 0, 0)).norm(), 1e-12);
    EXPECT_LT(right_from_left.rotation.vec().norm(), 1e-12);
  }
}

TEST_F(ColmapExport, pixels_have_their_centres_at_a_half_and_the_right_ones_lie_by_the_disparity) {
  const Map map = one_world();
  write_images(pattern(640, 480));
  const Model model = exported(map);
  const std::vector<Observation>& seen = map[KeyframeId{0}].observed.observations;
  std::size_t of_right = 0;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    EXPECT_LT((model.images[0].pixel(i) - Eigen::Vector2d(seen[i].u + 0.5, seen[i].v + 0.5)).norm(), 2e-4);
    if (!seen[i].has_disparity()) continue;  // each third
    const Eigen::Vector2d right(seen[i].u - seen[i].d + 0.5, seen[i].v + 0.5);
    EXPECT_LT((model.images[1].pixel(of_right++) - right).norm(), 2e-4);
  }
  EXPECT_EQ(model.images[1].points.size(), of_right);
  EXPECT_DOUBLE_EQ(model.cameras[0].parameters[2], kSceneRig.cx + 0.5);
  EXPECT_EQ(model.cameras[0].width, 640U);
  EXPECT_EQ(model.cameras[0].height, 480U);
}

TEST_F(ColmapExport, images_are_called_by_their_files) {
  write_images(pattern(640, 480));
  const Model model = exported(one_world());
  std::vector<std::string> names;
  for (const ModelImage& image : model.images) names.push_back(image.name);
  using Names = std::vector<std::string>;
  EXPECT_EQ(names, (Names{"image_0/100.png", "image_1/100.png", "image_0/110.png", "image_1/110.png",
                          "image_0/130.png", "image_1/130.png", "image_0/140.png", "image_1/140.png"}));
  EXPECT_EQ(colmap_image_root(sequence_), sequence_.folder);
}

TEST_F(ColmapExport, images_beside_the_sequence_have_a_root_above_it) {
  for (FrameFiles& files : sequence_.frames)
    files.right = folder_.path() / "seq/../other" / files.right.filename();
  EXPECT_EQ(colmap_image_root(sequence_), folder_.path());
  EXPECT_EQ(colmap_image_name(folder_.path(), sequence_.frames[3].color), "seq/image_0/103.png");
  EXPECT_EQ(colmap_image_name(folder_.path(), sequence_.frames[3].right), "other/103.png");
  sequence_.frames[7].right = folder_.path() / "other/a b.png";
  EXPECT_THROW(check_colmap_names(sequence_), InputError);
}

TEST_F(ColmapExport, points_have_the_colours_of_the_images) {
  write_images(pattern(640, 480));
  const Model model = exported(one_world());
  ASSERT_FALSE(model.points.empty());
  for (const ModelPoint& point : model.points) {
    std::vector<double> reds, greens;
    for (std::size_t k = 0; k < point.track.size(); k += 2) {
      if (model.images.at(point.track[k] - 1).camera != 1) continue;
      const Eigen::Vector2d pixel = model.images[point.track[k] - 1].pixel(point.track[k + 1]);
      reds.push_back(255 * std::clamp(pixel.x() - 0.5, 0.0, 639.0) / 640);
      greens.push_back(255 * std::clamp(pixel.y() - 0.5, 0.0, 479.0) / 480);
    }
    std::sort(reds.begin(), reds.end());
    std::sort(greens.begin(), greens.end());
    EXPECT_NEAR(point.color[0], reds[(reds.size() - 1) / 2], 1.6);
    EXPECT_NEAR(point.color[1], greens[(greens.size() - 1) / 2], 1.6);
    EXPECT_EQ(point.color[2], 77);
  }
}

TEST_F(ColmapExport, the_bytes_do_not_depend_on_the_threads) {
  write_images(pattern(640, 480));
  const Map map = one_world();
  (void)exported(map);
  const auto one = contents_of(model_);
  EXPECT_EQ(one.size(), 6U);
  (void)exported(map, 3);
  EXPECT_EQ(contents_of(model_), one);
}

TEST_F(ColmapExport, an_rgbd_sequence_has_one_camera_with_its_distortion) {
  sequence_.calibration.baseline.reset();
  sequence_.calibration.depth.emplace();
  sequence_.calibration.camera.model = CameraModel::radtan;
  sequence_.calibration.camera.distortion = {0.12, -0.2, 0.001, -0.002, 0.1};
  for (FrameFiles& files : sequence_.frames) files.right.clear();
  write_images(pattern(640, 480));
  Model model = exported(one_world());
  ASSERT_EQ(model.cameras.size(), 1U);
  EXPECT_EQ(model.cameras[0].model, "FULL_OPENCV");
  EXPECT_EQ(model.images.size(), 4U);
  expect_linked(model);
  sequence_.calibration.camera.distortion[4] = 0;
  model = exported(one_world());
  EXPECT_EQ(model.cameras[0].model, "OPENCV");
  expect_linked(model);
}

/// Exact observations of some points from some places, by a pair that is rectified on load.
Map rectified_map(const Calibration& calibration, const std::vector<FrameFiles>& frames) {
  const Camera& camera = calibration.camera;
  const Rig rig{camera.fx, camera.fy, camera.cx, camera.cy, *calibration.baseline};
  Map map(rig, "AKAZE");
  Random random(5);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 30; ++i)
    points.emplace_back(random.normal(), 0.6 * random.normal(), 5 + random.normal());
  for (int k = 0; k < 3; ++k) {
    const Rigid3 pose{rotation_exp(0.03 * k * Eigen::Vector3d(0.3, 1, -0.2)), {0.1 * k, 0.03 * k, 0.2 * k}};
    ObservedFrame frame = observe_points(points, pose, 61, random);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Eigen::Vector3d seen = rig.project(pose.inverse() * points[i]);
      frame.observations[i] = {seen.x(), seen.y(), seen.z(), 1, 0.3};
    }
    frame.frame = {10 * k};
    frame.stamp_ns = frames[10 * static_cast<std::size_t>(k)].stamp_ns;
    map.add_keyframe(std::move(frame), pose, k == 0 ? KeyframeId{} : KeyframeId{k - 1}, 0);
  }
  for (std::int32_t i = 0; i < 30; ++i) {
    const LandmarkId id = map.add_landmark(points[static_cast<std::size_t>(i)], {{0}, i});
    map.add_observation(id, {{1}, i});
    map.add_observation(id, {{2}, i});
  }
  return map;
}

TEST_F(ColmapExport, a_raw_pair_has_its_own_cameras_and_their_poses) {
  for (const CameraModel kind : {CameraModel::radtan, CameraModel::kb4}) {
    Camera left = scene_camera();
    left.model = kind;
    left.distortion = {-0.05, 0.01, 0.001, -0.002};
    Camera right = left;
    right.fx += 7, right.cy -= 5;
    const LeftFromRight left_from_right(Rigid3{rotation_exp({0.02, -0.03, 0.01}), {0.11, 0.004, -0.003}});
    set_raw_stereo({left, right, left_from_right}, {"camera.yaml", 1}, sequence_.calibration);
    write_images(pattern(640, 480));
    fs::copy_file(sequence_.frames[0].color, sequence_.frames[20].color,
                  fs::copy_options::overwrite_existing);
    const Model model = exported(rectified_map(sequence_.calibration, sequence_.frames));
    ASSERT_EQ(model.images.size(), 6U);
    EXPECT_EQ(model.cameras[1].model, kind == CameraModel::kb4 ? "OPENCV_FISHEYE" : "OPENCV");
    EXPECT_DOUBLE_EQ(model.cameras[1].parameters[0], right.fx);
    expect_linked(model);
    EXPECT_FALSE(model.points.empty());
    for (const ModelPoint& point : model.points) {
      EXPECT_EQ(point.track.size(), 12U);
      EXPECT_LT(point.error, 1e-3);  // the landmarks lie where both raw images show them
    }
    const Rigid3 found = model.images[0].camera_from_world() * model.images[1].camera_from_world().inverse();
    EXPECT_LT((found.translation - left_from_right.translation).norm(), 1e-9);
    EXPECT_LT(found.rotation.angularDistance(left_from_right.rotation), 1e-9);
  }
}

TEST_F(ColmapExport, says_where_a_camera_has_a_point_behind_it) {
  Map map = one_world();
  map.move(LandmarkId{1}, Eigen::Vector3d(0, 0, -5));
  write_images(pattern(640, 480));
  EXPECT_EQ(exported(map).points.at(0).error, -1);
}

std::string complaint_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const InputError& error) {
    return error.details().found;
  }
  return "none";
}

TEST_F(ColmapExport, refuses_worlds_that_are_not_connected) {
  EXPECT_EQ(complaint_of([&] { (void)exported(scene_map()); }), "keyframes of part 0 and of part 1");
}

TEST_F(ColmapExport, refuses_a_map_of_another_sequence_and_images_that_are_gone) {
  write_images(pattern(640, 480));
  ++sequence_.frames[10].stamp_ns;
  EXPECT_EQ(complaint_of([&] { (void)exported(one_world()); }),
            "keyframe 1 of frame 10 at 1305031453.459684001 s");
  --sequence_.frames[10].stamp_ns;
  fs::remove(sequence_.frames[30].color);
  EXPECT_NE(complaint_of([&] { (void)exported(one_world()); }), "none");
  EXPECT_FALSE(fs::exists(model_));
  Map continued = one_world();
  continued.end_recording();
  EXPECT_NE(complaint_of([&] { (void)exported(continued); }), "none");
}

}  // namespace
}  // namespace cairn
