// SPDX-License-Identifier: Apache-2.0
#include "cairn/map_files/colmap_files.h"

#include <cmath>
#include <span>

#include "cairn/geometry/unit_rotation.h"

namespace cairn {
namespace {

constexpr std::size_t kPiece = 1 << 16;

/// Describes a camera model of COLMAP and its parameters in COLMAP's order.
struct ColmapModel {
  const char* name;
  std::int32_t number;
  std::vector<double> parameters;
};

ColmapModel model_of(const Camera& camera) {
  constexpr double kPixelCentre = 0.5;
  std::vector<double> parameters{camera.fx, camera.fy, camera.cx + kPixelCentre, camera.cy + kPixelCentre};
  if (camera.model == CameraModel::pinhole) return {"PINHOLE", 1, parameters};
  const auto& d = camera.distortion;
  parameters.insert(parameters.end(), d.begin(), d.begin() + 4);
  if (camera.model == CameraModel::kb4) return {"OPENCV_FISHEYE", 5, parameters};
  if (d[4] == 0) return {"OPENCV", 4, parameters};
  parameters.insert(parameters.end(), {d[4], 0, 0, 0});
  return {"FULL_OPENCV", 6, parameters};
}

/// Returns the double that a text with so many decimals is read as: 10^decimals is exact, and so is the
/// quotient's rounding.
double rounded(double value, double scale) {
  return std::round(value * scale) / scale;
}

}  // namespace

ColmapWriter::Pair::Pair(const std::filesystem::path& folder, const std::string& name, std::uint64_t count)
    : text_file_(folder / (name + ".txt")), binary_file_(folder / (name + ".bin")) {
  bytes_.put(count);
}

void ColmapWriter::Pair::flush() {
  text_file_.write({text_.data(), text_.size()});
  binary_file_.write(bytes_.bytes());
  text_.clear();
  bytes_ = {};
}

void ColmapWriter::Pair::flush_if_large() {
  if (text_.size() >= kPiece || bytes_.bytes().size() >= kPiece) flush();
}

void ColmapWriter::Pair::commit() {
  flush();
  text_file_.commit();
  binary_file_.commit();
}

ColmapWriter::ColmapWriter(const std::filesystem::path& folder, const ColmapCounts& counts)
    : cameras_(folder, "cameras", counts.cameras),
      images_(folder, "images", counts.images),
      points_(folder, "points3D", counts.points) {
  cameras_.print("# CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]; pixels have their centres at .5\n");
  images_.print(
      "# IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, CAMERA_ID, NAME; POINTS2D[] as (X, Y, POINT3D_ID)\n");
  points_.print("# POINT3D_ID, X, Y, Z, R, G, B, ERROR, TRACK[] as (IMAGE_ID, POINT2D_IDX)\n");
}

void ColmapWriter::add_camera(std::uint32_t number, const Camera& camera) {
  const ColmapModel model = model_of(camera);
  cameras_.print("{} {} {} {}", number, model.name, camera.width, camera.height);
  cameras_.put(number, model.number, static_cast<std::uint64_t>(camera.width),
               static_cast<std::uint64_t>(camera.height));
  for (const double parameter : model.parameters) {
    cameras_.print(" {}", parameter);
    cameras_.put(parameter);
  }
  cameras_.print("\n");
}

void ColmapWriter::add_image(const ColmapImage& image) {
  const Eigen::Quaterniond q = unit_rotation(image.camera_from_world.rotation);
  const Eigen::Vector3d& t = image.camera_from_world.translation;
  images_.print("{} {} {} {} {} {} {} {} {} {}\n", image.number, q.w(), q.x(), q.y(), q.z(), t.x(), t.y(),
                t.z(), image.camera, image.name);
  images_.put(image.number, q.w(), q.x(), q.y(), q.z(), t.x(), t.y(), t.z(), image.camera);
  images_.put_name(image.name);
  images_.put(static_cast<std::uint64_t>(image.pixels.size()));
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const ColmapPixel& seen = image.pixels[i];
    const double x = rounded(seen.pixel.x(), 1e4), y = rounded(seen.pixel.y(), 1e4);
    images_.print("{}{:.4f} {:.4f} {}", i == 0 ? "" : " ", x, y, seen.point);
    images_.put(x, y, static_cast<std::uint64_t>(seen.point));  // -1 becomes the number of no point
  }
  images_.print("\n");
  images_.flush_if_large();
}

void ColmapWriter::add_point(const ColmapPoint& point) {
  const Eigen::Vector3d& p = point.point_in_world;
  const Rgb8& color = point.color;
  const double error = rounded(point.error_px, 1e5);
  points_.print("{} {} {} {} {} {} {} {:.5f}", point.number, p.x(), p.y(), p.z(), color.r, color.g, color.b,
                error);
  points_.put(point.number, p.x(), p.y(), p.z(), color.r, color.g, color.b, error,
              static_cast<std::uint64_t>(point.track.size()));
  for (const auto& [image, pixel] : point.track) {
    points_.print(" {} {}", image, pixel);
    points_.put(image, pixel);
  }
  points_.print("\n");
  points_.flush_if_large();
}

void ColmapWriter::commit() {
  cameras_.commit();
  images_.commit();
  points_.commit();
}

}  // namespace cairn
