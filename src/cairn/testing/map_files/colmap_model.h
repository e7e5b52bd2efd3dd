// SPDX-License-Identifier: Apache-2.0
// Readers of COLMAP's sparse models, text and binary, after colmap.github.io/format.html.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "cairn/geometry/rigid3.h"

namespace cairn::testkit {

/// Holds a line of cameras.txt.
struct ModelCamera {
  std::uint32_t number = 0;
  std::string model;
  std::uint64_t width = 0, height = 0;
  std::vector<double> parameters;
  bool operator==(const ModelCamera&) const = default;
};

/// Holds two lines of images.txt.
struct ModelImage {
  std::uint32_t number = 0, camera = 0;
  std::vector<double> pose;  ///< qw qx qy qz tx ty tz, camera_from_world
  std::string name;
  std::vector<double> pixels;  ///< x and y of each
  std::vector<std::int64_t> points;
  bool operator==(const ModelImage&) const = default;

  [[nodiscard]] Rigid3 camera_from_world() const {
    return {Eigen::Quaterniond(pose[0], pose[1], pose[2], pose[3]), {pose[4], pose[5], pose[6]}};
  }
  [[nodiscard]] Eigen::Vector2d pixel(std::size_t i) const {
    return {pixels.at(2 * i), pixels.at(2 * i + 1)};
  }
};

/// Holds a line of points3D.txt.
struct ModelPoint {
  std::uint64_t number = 0;
  std::vector<double> place;
  std::vector<int> color;
  double error = 0;
  std::vector<std::uint32_t> track;  ///< number of the image, of its pixel, and so on
  bool operator==(const ModelPoint&) const = default;

  [[nodiscard]] Eigen::Vector3d point_in_world() const { return {place[0], place[1], place[2]}; }
};

/// Holds a sparse model.
struct Model {
  std::vector<ModelCamera> cameras;
  std::vector<ModelImage> images;
  std::vector<ModelPoint> points;
  bool operator==(const Model&) const = default;
};

/// Returns a text file's lines without comments; an empty line may be an image without features.
[[nodiscard]] std::vector<std::string> lines_of(const std::filesystem::path& path);

/// Returns the model in cameras.txt, images.txt and points3D.txt. A test fails if one of them is broken.
[[nodiscard]] Model read_text_model(const std::filesystem::path& folder);

/// Returns the model in cameras.bin, images.bin and points3D.bin. A test fails if one of them is broken.
[[nodiscard]] Model read_binary_model(const std::filesystem::path& folder);

/// Returns the pixel of a point by a camera of the model, whose pixels have their centres at .5; the
/// equations are those that COLMAP documents for its models (OpenCV's).
[[nodiscard]] Eigen::Vector2d project(const ModelCamera& camera, const Eigen::Vector3d& point_in_camera);

}  // namespace cairn::testkit
