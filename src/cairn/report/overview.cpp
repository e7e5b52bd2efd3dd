// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/overview.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cairn {
namespace {

constexpr double kFocalPerWidth = 1.25;  // 44 degrees: room for depth, little distortion

/// world_from_camera rotation of a camera that looks along `forward`, its picture upright for `up`.
Eigen::Matrix3d look_along(const Eigen::Vector3d& forward, const Eigen::Vector3d& up) {
  Eigen::Matrix3d rotation;
  rotation.col(2) = forward.normalized();
  rotation.col(0) = forward.cross(up).normalized();
  rotation.col(1) = rotation.col(2).cross(rotation.col(0));
  return rotation;
}

Camera view_camera(int width, int height) {
  Camera camera;
  camera.width = width;
  camera.height = height;
  camera.fx = camera.fy = kFocalPerWidth * width;
  camera.cx = 0.5 * (width - 1);
  camera.cy = 0.5 * (height - 1);
  return camera;
}

/// The value below which all but half a percent lie: stray points do not decide how far away the eye is.
double high_quantile(std::vector<double>& values) {
  const auto place = static_cast<std::ptrdiff_t>(0.995 * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + place, values.end());
  return values[static_cast<std::size_t>(place)];
}

/// Where the eye must be so that the cells and the whole path just fit: with k the tangent of half the view,
/// |x - cx| <= k (z - cz) for all points bounds cz and gives cx; the same for y.
Eigen::Vector3d fit_eye(const std::vector<SurfaceCell>& cells, const std::vector<Rigid3>& path,
                        const Eigen::Matrix3d& world_from_view, const Camera& camera) {
  constexpr double kMargin = 0.94;
  const Eigen::Vector2d tangent =
      kMargin * Eigen::Vector2d(0.5 * camera.width / camera.fx, 0.5 * camera.height / camera.fy);
  Eigen::Vector3d eye_in_view = Eigen::Vector3d::Zero();
  eye_in_view.z() = 1e12;
  for (int axis = 0; axis < 2; ++axis) {
    std::vector<double> right, left;
    for (const SurfaceCell& cell : cells) {
      const Eigen::Vector3d p = world_from_view.transpose() * cell.centre.cast<double>();
      right.push_back(p[axis] - tangent[axis] * p.z());
      left.push_back(-p[axis] - tangent[axis] * p.z());
    }
    double a = high_quantile(right), b = high_quantile(left);
    for (const Rigid3& world_from_camera : path) {
      const Eigen::Vector3d p = world_from_view.transpose() * world_from_camera.translation;
      a = std::max(a, p[axis] - tangent[axis] * p.z());
      b = std::max(b, -p[axis] - tangent[axis] * p.z());
    }
    eye_in_view[axis] = 0.5 * (a - b);
    eye_in_view.z() = std::min(eye_in_view.z(), -0.5 * (a + b) / tangent[axis]);
  }
  return world_from_view * eye_in_view;
}

RenderCamera fit_view(const CloudSurface& surface, const std::vector<Rigid3>& path, const Eigen::Vector3d& up,
                      double azimuth, double elevation, int width, int height) {
  const Eigen::Vector3d side = up.unitOrthogonal();
  const Eigen::Vector3d level = std::cos(azimuth) * side + std::sin(azimuth) * up.cross(side);
  const Eigen::Matrix3d rotation = look_along(std::cos(elevation) * level - std::sin(elevation) * up, up);
  RenderCamera view{view_camera(width, height), {}};
  view.world_from_camera.rotation = Eigen::Quaterniond(rotation);
  view.world_from_camera.translation = fit_eye(surface.cells(), path, rotation, view.camera);
  return view;
}

/// How much of the cloud a view shows: each pixel of a small picture counts as much as what it shows faces
/// the viewer; what faces away is not drawn.
double score(const CloudSurface& surface, const RenderCamera& view) {
  const Rigid3 camera_from_world = view.world_from_camera.inverse();
  DepthImage depth(view.camera.width, view.camera.height, 1e9F);
  Image<float> facing(view.camera.width, view.camera.height, 0.0F);
  for (const SurfaceCell& cell : surface.cells()) {
    const Eigen::Vector3d centre = cell.centre.cast<double>();
    const Eigen::Vector3d way = (view.world_from_camera.translation - centre).normalized();
    const double cosine = cell.normal.cast<double>().dot(way);
    const Eigen::Vector3d p = camera_from_world * centre;
    if ((cell.seen && cosine < 0) || p.z() <= 0) continue;
    const auto pixel = view.camera.project(p);
    const int radius = static_cast<int>(0.5 * surface.cell_size() * view.camera.fx / p.z());
    const int u = static_cast<int>(std::lround(pixel->x())), v = static_cast<int>(std::lround(pixel->y()));
    for (int y = v - radius; y <= v + radius; ++y) {
      for (int x = u - radius; x <= u + radius; ++x) {
        if (!depth.contains(x, y) || static_cast<double>(depth(x, y)) <= p.z()) continue;
        depth(x, y) = static_cast<float>(p.z());
        facing(x, y) = static_cast<float>(std::abs(cosine));
      }
    }
  }
  double sum = 0;
  for (std::size_t i = 0; i < facing.size(); ++i) sum += static_cast<double>(facing.data()[i]);
  return sum;
}

Eigen::Vector3d mean_camera_up(const std::vector<Rigid3>& path) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Rigid3& world_from_camera : path) sum -= world_from_camera.matrix3().col(1);
  return sum.norm() > 1e-9 ? sum.normalized() : Eigen::Vector3d::UnitZ();
}

}  // namespace

Eigen::Vector3d estimate_up(const CloudSurface& surface, const std::vector<Rigid3>& path) {
  constexpr double kFlat = 0.9;
  Eigen::Vector3d up = mean_camera_up(path);
  for (const double degrees : {40.0, 30.0, 20.0, 12.0, 8.0, 8.0, 8.0}) {
    const double least = std::cos(degrees * std::numbers::pi / 180.0);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const SurfaceCell& cell : surface.cells()) {
      const Eigen::Vector3d normal = cell.normal.cast<double>();
      const double along = normal.dot(up);
      if (static_cast<double>(cell.flatness) < kFlat || std::abs(along) < least) continue;
      sum += along > 0 ? normal : Eigen::Vector3d(-normal);
    }
    if (sum.norm() > 0) up = sum.normalized();
  }
  return up;
}

RenderCamera overview_of(const CloudSurface& surface, const std::vector<Rigid3>& path, int width,
                         int height) {
  constexpr int kAzimuths = 24;
  constexpr int kSmallWidth = 200;
  constexpr double kDegree = std::numbers::pi / 180.0;
  const Eigen::Vector3d up = estimate_up(surface, path);
  if (surface.cells().empty()) return {view_camera(width, height), {}};
  const int small_height = std::max(1, kSmallWidth * height / width);
  double best = -1, best_azimuth = 0, best_elevation = 0;
  for (const double elevation : {30 * kDegree, 40 * kDegree, 50 * kDegree}) {
    for (int i = 0; i < kAzimuths; ++i) {
      const double azimuth = 2 * std::numbers::pi * i / kAzimuths;
      const double value =
          score(surface, fit_view(surface, path, up, azimuth, elevation, kSmallWidth, small_height));
      if (value <= best) continue;
      best = value;
      best_azimuth = azimuth;
      best_elevation = elevation;
    }
  }
  return fit_view(surface, path, up, best_azimuth, best_elevation, width, height);
}

RgbImage draw_overview(const Cloud& cloud, const CameraPath& path, double voxel_size, int width, int height) {
  const double cell_size = std::max(0.06, 4 * voxel_size);  // metres: above a Kinect's noise at 4 m
  const CloudSurface surface(cloud, path.world_from_camera, cell_size);
  RenderOptions options;
  options.point_size = voxel_size;
  return render_cloud(cloud, overview_of(surface, path.world_from_camera, width, height), options, &surface,
                      &path);
}

}  // namespace cairn
