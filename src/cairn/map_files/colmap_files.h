// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "cairn/core/file.h"
#include "cairn/geometry/camera.h"
#include "cairn/geometry/framed.h"
#include "cairn/image/image.h"
#include "cairn/map_files/binary_file.h"

namespace cairn {

/// Describes a feature of an image of a COLMAP model.
struct ColmapPixel {
  Eigen::Vector2d pixel;    ///< position, pixels; COLMAP's pixels have their centres at .5
  std::int64_t point = -1;  ///< number of the point that it shows, -1 if none
};

/// Describes an image of a COLMAP model.
struct ColmapImage {
  std::uint32_t number = 0, camera = 0;
  CameraFromWorld camera_from_world;
  std::string name;
  std::vector<ColmapPixel> pixels;
};

/// Describes a point of a COLMAP model.
struct ColmapPoint {
  std::uint64_t number = 0;
  Eigen::Vector3d point_in_world = Eigen::Vector3d::Zero();
  Rgb8 color;
  double error_px = -1;  ///< mean reprojection error; -1 if unknown, as COLMAP has it
  std::vector<std::pair<std::uint32_t, std::uint32_t>> track;  ///< numbers of an image and of a pixel in it
};

/// Holds how many cameras, images and points a model has.
struct ColmapCounts {
  std::uint64_t cameras = 0, images = 0, points = 0;
};

/// Writes a sparse model of COLMAP (Schoenberger & Frahm 2016, colmap.github.io/format.html) in both forms at
/// once: cameras, images and points3D as .txt and as .bin, with the same values. Pixels are rounded to 1e-4,
/// errors to 1e-5 pixels. The files appear under their names with commit(). Throws InputError if the disk
/// fails.
class ColmapWriter {
 public:
  /// Begins a model in `folder`, which exists; the counts are those of the calls that follow.
  ColmapWriter(const std::filesystem::path& folder, const ColmapCounts& counts);

  /// Adds a camera: pinhole becomes PINHOLE, radtan OPENCV or (with a third radial coefficient) FULL_OPENCV,
  /// kb4 OPENCV_FISHEYE.
  void add_camera(std::uint32_t number, const Camera& camera);
  /// Adds an image with its features.
  void add_image(const ColmapImage& image);
  /// Adds a point with its track.
  void add_point(const ColmapPoint& point);
  void commit();

 private:
  /// Writes a text file and a binary file side by side.
  class Pair {
   public:
    Pair(const std::filesystem::path& folder, const std::string& name, std::uint64_t count);
    template <class... Values>
    void print(fmt::format_string<Values...> format, Values&&... values) {
      fmt::format_to(std::back_inserter(text_), format, std::forward<Values>(values)...);
    }
    template <class... Values>
    void put(Values... values) {
      (bytes_.put(values), ...);
    }
    void put_name(const std::string& name) { bytes_.put_bytes(name.c_str(), name.size() + 1); }
    void flush_if_large();
    void commit();

   private:
    void flush();
    AtomicFile text_file_, binary_file_;
    fmt::memory_buffer text_;
    ByteWriter bytes_;
  };

  Pair cameras_, images_, points_;
};

}  // namespace cairn
