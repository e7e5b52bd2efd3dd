// SPDX-License-Identifier: Apache-2.0
#include "cairn/testing/map_files/colmap_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <sstream>
#include <utility>

#include "cairn/core/file.h"

namespace cairn::testkit {

namespace {

/// Gives a line's words, in order.
class Words {
 public:
  explicit Words(const std::string& line) : stream_(line) {}
  template <class Value>
  Value next() {
    Value value{};
    EXPECT_TRUE(stream_ >> value);
    return value;
  }
  template <class Value>
  std::vector<Value> next(std::size_t count) {
    std::vector<Value> values;
    for (std::size_t i = 0; i < count; ++i) values.push_back(next<Value>());
    return values;
  }
  [[nodiscard]] bool at_end() { return (stream_ >> std::ws).eof(); }

 private:
  std::istringstream stream_;
};

/// Gives the little-endian values of a file, in order.
class Bytes {
 public:
  explicit Bytes(const std::filesystem::path& path) : bytes_(read_file(path)) {}
  template <class Value>
  Value next() {
    Value value{};
    EXPECT_LE(next_ + sizeof value, bytes_.size());
    if (next_ + sizeof value <= bytes_.size()) std::memcpy(&value, bytes_.data() + next_, sizeof value);
    next_ += sizeof value;
    return value;
  }
  template <class Value>
  std::vector<Value> next(std::size_t count) {
    std::vector<Value> values;
    for (std::size_t i = 0; i < count; ++i) values.push_back(next<Value>());
    return values;
  }
  std::string next_name() {
    std::string name = bytes_.c_str() + next_;
    next_ += name.size() + 1;
    return name;
  }
  ~Bytes() { EXPECT_EQ(next_, bytes_.size()); }
  Bytes(const Bytes&) = delete;
  Bytes& operator=(const Bytes&) = delete;

 private:
  std::string bytes_;
  std::size_t next_ = 0;
};

ModelImage read_image(const std::string& first_line, const std::string& second_line) {
  Words words(first_line), features(second_line);
  ModelImage image;
  image.number = words.next<std::uint32_t>();
  image.pose = words.next<double>(7);
  image.camera = words.next<std::uint32_t>();
  image.name = words.next<std::string>();
  while (!features.at_end()) {
    for (int k = 0; k < 2; ++k) image.pixels.push_back(features.next<double>());
    image.points.push_back(features.next<std::int64_t>());
  }
  return image;
}

}  // namespace

std::vector<std::string> lines_of(const std::filesystem::path& path) {
  std::istringstream stream(read_file(path));
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);)
    if (!line.starts_with("#")) lines.push_back(line);
  return lines;
}

Model read_text_model(const std::filesystem::path& folder) {
  Model model;
  for (const std::string& line : lines_of(folder / "cameras.txt")) {
    Words words(line);
    ModelCamera camera{words.next<std::uint32_t>(),
                       words.next<std::string>(),
                       words.next<std::uint64_t>(),
                       words.next<std::uint64_t>(),
                       {}};
    while (!words.at_end()) camera.parameters.push_back(words.next<double>());
    model.cameras.push_back(camera);
  }
  const std::vector<std::string> lines = lines_of(folder / "images.txt");
  for (std::size_t i = 0; i + 1 < lines.size(); i += 2)
    model.images.push_back(read_image(lines[i], lines[i + 1]));
  for (const std::string& line : lines_of(folder / "points3D.txt")) {
    Words words(line);
    ModelPoint point{
        words.next<std::uint64_t>(), words.next<double>(3), words.next<int>(3), words.next<double>(), {}};
    while (!words.at_end()) point.track.push_back(words.next<std::uint32_t>());
    model.points.push_back(point);
  }
  return model;
}

Model read_binary_model(const std::filesystem::path& folder) {
  const std::vector<std::pair<std::string, std::size_t>> kinds{
      {"SIMPLE_PINHOLE", 3}, {"PINHOLE", 4},        {"SIMPLE_RADIAL", 4}, {"RADIAL", 5},
      {"OPENCV", 8},         {"OPENCV_FISHEYE", 8}, {"FULL_OPENCV", 12}};
  Model model;
  Bytes cameras(folder / "cameras.bin"), images(folder / "images.bin"), points(folder / "points3D.bin");
  for (auto count = cameras.next<std::uint64_t>(); count > 0; --count) {
    const auto number = cameras.next<std::uint32_t>();
    const auto& [name, parameters] = kinds.at(static_cast<std::size_t>(cameras.next<std::int32_t>()));
    const auto width = cameras.next<std::uint64_t>(), height = cameras.next<std::uint64_t>();
    model.cameras.push_back({number, name, width, height, cameras.next<double>(parameters)});
  }
  for (auto count = images.next<std::uint64_t>(); count > 0; --count) {
    ModelImage image;
    image.number = images.next<std::uint32_t>();
    image.pose = images.next<double>(7);
    image.camera = images.next<std::uint32_t>();
    image.name = images.next_name();
    for (auto pixels = images.next<std::uint64_t>(); pixels > 0; --pixels) {
      for (int k = 0; k < 2; ++k) image.pixels.push_back(images.next<double>());
      image.points.push_back(static_cast<std::int64_t>(images.next<std::uint64_t>()));
    }
    model.images.push_back(image);
  }
  for (auto count = points.next<std::uint64_t>(); count > 0; --count) {
    ModelPoint point{points.next<std::uint64_t>(), points.next<double>(3), {}, 0, {}};
    for (int channel = 0; channel < 3; ++channel) point.color.push_back(points.next<std::uint8_t>());
    point.error = points.next<double>();
    point.track = points.next<std::uint32_t>(2 * points.next<std::uint64_t>());
    model.points.push_back(point);
  }
  return model;
}

Eigen::Vector2d project(const ModelCamera& camera, const Eigen::Vector3d& point_in_camera) {
  const std::vector<double>& p = camera.parameters;
  const double x = point_in_camera.x() / point_in_camera.z(), y = point_in_camera.y() / point_in_camera.z();
  const double r2 = x * x + y * y;
  Eigen::Vector2d bent(x, y);
  if (camera.model == "OPENCV" || camera.model == "FULL_OPENCV") {
    const double k3 = p.size() > 8 ? p[8] : 0;
    const double radial = 1 + r2 * (p[4] + r2 * (p[5] + r2 * k3));
    bent = {x * radial + 2 * p[6] * x * y + p[7] * (r2 + 2 * x * x),
            y * radial + 2 * p[7] * x * y + p[6] * (r2 + 2 * y * y)};
  } else if (camera.model == "OPENCV_FISHEYE") {
    const double r = std::sqrt(r2), theta = std::atan(r), t2 = theta * theta;
    bent *= theta / r * (1 + t2 * (p[4] + t2 * (p[5] + t2 * (p[6] + t2 * p[7]))));
  } else {
    EXPECT_EQ(camera.model, "PINHOLE");
  }
  return {p[0] * bent.x() + p[2], p[1] * bent.y() + p[3]};
}

}  // namespace cairn::testkit
