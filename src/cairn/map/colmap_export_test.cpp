// SPDX-License-Identifier: Apache-2.0
#include "cairn/map/colmap_export.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <vector>

#include "cairn/map/test_map.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;

/// A line's words, in order.
class Words {
 public:
  explicit Words(const std::string& line) : stream_(line) {}
  template <class Value>
  Value next() {
    Value value{};
    EXPECT_TRUE(stream_ >> value);
    return value;
  }
  [[nodiscard]] bool at_end() { return (stream_ >> std::ws).eof(); }

 private:
  std::istringstream stream_;
};

struct ModelImage {
  int number = 0;
  Rigid3 camera_from_world;
  std::string name;
  std::vector<Eigen::Vector2d> pixels;
  std::vector<int> points;
};

struct ModelPoint {
  Eigen::Vector3d point_in_world;
  double error = 0;
  std::vector<std::pair<int, int>> track;
};

/// Without comments; an empty line may be an image without features.
std::vector<std::string> lines_of(const fs::path& path) {
  std::istringstream stream(read_file(path));
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);)
    if (!line.starts_with("#")) lines.push_back(line);
  return lines;
}

std::vector<ModelImage> read_images(const fs::path& folder) {
  const std::vector<std::string> lines = lines_of(folder / "images.txt");
  std::vector<ModelImage> images;
  for (std::size_t i = 0; i + 1 < lines.size(); i += 2) {
    Words words(lines[i]);
    ModelImage image;
    image.number = words.next<int>();
    auto& q = image.camera_from_world.rotation;
    for (double* value : {&q.w(), &q.x(), &q.y(), &q.z()}) *value = words.next<double>();
    for (double& value : image.camera_from_world.translation) value = words.next<double>();
    EXPECT_EQ(words.next<int>(), 1);
    image.name = words.next<std::string>();
    Words features(lines[i + 1]);
    while (!features.at_end()) {
      const double u = features.next<double>();
      image.pixels.emplace_back(u, features.next<double>());
      image.points.push_back(features.next<int>());
    }
    images.push_back(image);
  }
  return images;
}

std::vector<ModelPoint> read_points(const fs::path& folder) {
  std::vector<ModelPoint> points;
  for (const std::string& line : lines_of(folder / "points3D.txt")) {
    Words words(line);
    EXPECT_EQ(words.next<std::size_t>(), points.size() + 1);
    ModelPoint point;
    for (double& value : point.point_in_world) value = words.next<double>();
    for (int channel = 0; channel < 3; ++channel) EXPECT_EQ(words.next<int>(), 128);
    point.error = words.next<double>();
    while (!words.at_end()) {
      const int image = words.next<int>();
      point.track.emplace_back(image, words.next<int>());
    }
    points.push_back(point);
  }
  return points;
}

/// The scene in one world; three keyframes of five are left of the first recording's.
Map one_world() {
  Map map = scene_map();
  map.set_part({3}, 0);
  map.set_part({4}, 0);
  return map;
}

/// By the camera that cameras.txt has.
Eigen::Vector2d project(const fs::path& folder, const Eigen::Vector3d& point_in_camera) {
  Words words(lines_of(folder / "cameras.txt").at(0));
  EXPECT_EQ(words.next<int>(), 1);
  EXPECT_EQ(words.next<std::string>(), "PINHOLE");
  EXPECT_EQ(words.next<int>() + words.next<int>(), 0);  // the size is not known
  const double fx = words.next<double>(), fy = words.next<double>(), cx = words.next<double>();
  return {fx * point_in_camera.x() / point_in_camera.z() + cx,
          fy * point_in_camera.y() / point_in_camera.z() + words.next<double>()};
}

TEST(ColmapExport, tracks_lead_to_the_pixels_that_show_the_point) {
  const TestFolder folder;
  const Map map = one_world();
  write_map(folder.path() / "map", map);
  write_colmap_model(folder.path() / "map", folder.path() / "model");
  const std::vector<ModelImage> images = read_images(folder.path() / "model");
  const std::vector<ModelPoint> points = read_points(folder.path() / "model");
  ASSERT_EQ(images.size(), 4U);
  ASSERT_EQ(points.size(), 8U);
  std::size_t shown = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    double sum = 0;
    for (const auto& [image, feature] : points[i].track) {
      const ModelImage& of = images.at(static_cast<std::size_t>(image - 1));
      EXPECT_EQ(of.points.at(static_cast<std::size_t>(feature)), static_cast<int>(i) + 1);
      sum += (project(folder.path() / "model", of.camera_from_world * points[i].point_in_world) -
              of.pixels.at(static_cast<std::size_t>(feature)))
                 .norm();
    }
    shown += points[i].track.size();
    EXPECT_NEAR(points[i].error, sum / static_cast<double>(points[i].track.size()), 2e-4);
    EXPECT_GT(points[i].error, 0.01);  // of noise; a pixel's half that was forgotten would add to it
    EXPECT_LT(points[i].error, 12);
  }
  std::size_t of_points = 0;
  for (const ModelImage& image : images)
    for (const int point : image.points) of_points += point > 0 ? 1 : 0;
  EXPECT_EQ(shown, of_points);
}

TEST(ColmapExport, pixels_have_their_centres_at_a_half) {
  const TestFolder folder;
  const Map map = one_world();
  write_map(folder.path() / "map", map);
  write_colmap_model(folder.path() / "map", folder.path() / "model");
  const std::vector<ModelImage> images = read_images(folder.path() / "model");
  const Observation& seen = map[KeyframeId{0}].observed.observations[3];
  EXPECT_NEAR(images[0].pixels.at(3).x(), seen.u + 0.5, 1e-4);
  EXPECT_NEAR(images[0].pixels.at(3).y(), seen.v + 0.5, 1e-4);
  const Eigen::Vector2d centre = project(folder.path() / "model", {0, 0, 1});
  EXPECT_DOUBLE_EQ(centre.x(), kSceneRig.cx + 0.5);
  EXPECT_DOUBLE_EQ(centre.y(), kSceneRig.cy + 0.5);
}

TEST(ColmapExport, images_are_called_by_frames_or_else_by_keyframes) {
  const TestFolder folder;
  Map map = one_world();
  const auto names = [&](const char* name) {
    write_map(folder.path() / name, map);
    write_colmap_model(folder.path() / name, folder.path() / name / "colmap");
    std::vector<std::string> found;
    for (const ModelImage& image : read_images(folder.path() / name / "colmap")) found.push_back(image.name);
    return found;
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(names("one"), (Names{"000000.png", "000010.png", "000030.png", "000040.png"}));
  map.end_recording();
  EXPECT_EQ(names("two"), (Names{"000000.png", "000001.png", "000002.png", "000003.png"}));
}

TEST(ColmapExport, says_where_a_camera_has_a_point_behind_it) {
  const TestFolder folder;
  Map map = one_world();
  map.move(LandmarkId{1}, Eigen::Vector3d(0, 0, -5));
  write_map(folder.path() / "map", map);
  write_colmap_model(folder.path() / "map", folder.path() / "model");
  EXPECT_EQ(read_points(folder.path() / "model").at(0).error, -1);
}

TEST(ColmapExport, refuses_worlds_that_are_not_connected) {
  const TestFolder folder;
  write_map(folder.path() / "map", scene_map());
  try {
    write_colmap_model(folder.path() / "map", folder.path() / "model");
    FAIL() << "wrote two worlds as one";
  } catch (const InputError& error) {
    EXPECT_EQ(error.details().found, "keyframes of part 0 and of part 1");
  }
}

}  // namespace
}  // namespace cairn
