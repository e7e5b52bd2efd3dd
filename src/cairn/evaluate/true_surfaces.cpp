// SPDX-License-Identifier: Apache-2.0
#include "cairn/evaluate/true_surfaces.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "cairn/core/error.h"

namespace cairn {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kFewestPixels = 8;
constexpr double kLeastRcond = 1e-6;  // pixels of one line leave a plane free to turn about it

/// Inverse depth a + b du + c dv over a window, du and dv in pixels from its centre: that of a plane is
/// linear in the image.
using InverseDepth = Vector3d;

struct WindowPixel {
  int du = 0, dv = 0;      ///< from the centre of the window
  Vector3d place;          ///< 1, du, dv
  double z = 0;            ///< metres
  double distance_px = 0;  ///< from the position asked for
  bool taken = false;      ///< lies on a plane that was found
};

/// The pixels with a depth around a position.
class Window {
 public:
  Window(const RawDepthImage& depth, const Vector2d& pixel, const SurfaceOptions& options)
      : unit_(1 / options.units_per_metre),
        u_(static_cast<int>(std::lround(pixel.x()))),
        v_(static_cast<int>(std::lround(pixel.y()))),
        half_(options.half_window) {
    for (int v = v_ - half_; v <= v_ + half_; ++v) {
      for (int u = u_ - half_; u <= u_ + half_; ++u) {
        const bool is_known = depth.contains(u, v) && depth(u, v) > 0;
        index_.push_back(is_known ? static_cast<int>(pixels_.size()) : -1);
        if (!is_known) continue;
        pixels_.push_back({u - u_,
                           v - v_,
                           {1.0, 1.0 * (u - u_), 1.0 * (v - v_)},
                           unit_ * depth(u, v),
                           std::hypot(u - pixel.x(), v - pixel.y())});
      }
    }
  }

  /// Returns the pixels within reach, the nearest first.
  [[nodiscard]] std::vector<std::size_t> within(double reach_px) const {
    std::vector<std::size_t> near;
    for (std::size_t i = 0; i < pixels_.size(); ++i)
      if (pixels_[i].distance_px <= reach_px) near.push_back(i);
    std::stable_sort(near.begin(), near.end(), [&](std::size_t a, std::size_t b) {
      return pixels_[a].distance_px < pixels_[b].distance_px;
    });
    return near;
  }

  [[nodiscard]] bool is_taken(std::size_t pixel) const { return pixels_[pixel].taken; }

  /// Finds the plane through a pixel that most pixels lie on, and takes these. Returns nullopt if it is too
  /// small.
  std::optional<InverseDepth> take_plane(std::size_t through) {
    std::optional<InverseDepth> best;
    std::size_t most = kFewestPixels - 1;
    for (const auto& [a, b] : kPartners) {
      const auto plane = fit_from(through, a, b);
      if (!plane || !is_on(*plane, pixels_[through], 1)) continue;
      const std::size_t count = count_on(*plane);
      if (count > most) best = plane, most = count;
      if (2 * most >= pixels_.size()) break;  // no other plane has more
    }
    for (WindowPixel& pixel : pixels_)
      if (best && is_on(*best, pixel, 1)) pixel.taken = true;
    return best;
  }

  /// Returns the plane in the camera's frame: 1/z = m . (x/z, y/z, 1) with the normal along m.
  [[nodiscard]] Plane in_camera(const InverseDepth& plane, const Camera& camera) const {
    const Vector3d m(plane[1] * camera.fx, plane[2] * camera.fy,
                     plane[0] + plane[1] * (camera.cx - u_) + plane[2] * (camera.cy - v_));
    return {m.normalized(), 1 / m.norm()};
  }

 private:
  using Step = std::pair<int, int>;  // columns and rows to another pixel
  static constexpr std::array<std::pair<Step, Step>, 8> kPartners = {{{{3, 0}, {0, 3}},
                                                                      {{-3, 0}, {0, 3}},
                                                                      {{3, 0}, {0, -3}},
                                                                      {{-3, 0}, {0, -3}},
                                                                      {{1, 0}, {0, 2}},
                                                                      {{-1, 0}, {0, 2}},
                                                                      {{1, 0}, {0, -2}},
                                                                      {{-1, 0}, {0, -2}}}};

  [[nodiscard]] const WindowPixel* at(const WindowPixel& from, const Step& step) const {
    const int du = from.du + step.first, dv = from.dv + step.second;
    if (std::max(std::abs(du), std::abs(dv)) > half_) return nullptr;
    const int place = (dv + half_) * (2 * half_ + 1) + du + half_;
    const int index = index_[static_cast<std::size_t>(place)];
    return index < 0 ? nullptr : &pixels_[static_cast<std::size_t>(index)];
  }

  /// Tells whether a pixel lies on a plane within so many units of the depth.
  [[nodiscard]] bool is_on(const InverseDepth& plane, const WindowPixel& pixel, double units) const {
    const double inverse = plane.dot(pixel.place);
    return inverse > 0 && std::abs(1 / inverse - pixel.z) <= units * unit_;
  }

  [[nodiscard]] std::size_t count_on(const InverseDepth& plane) const {
    return static_cast<std::size_t>(std::count_if(pixels_.begin(), pixels_.end(),
                                                  [&](const auto& pixel) { return is_on(plane, pixel, 1); }));
  }

  /// Fits a plane to three pixels, then to those near it, nearer each time: three alone leave open where the
  /// plane is at the rim of the window, by several units.
  [[nodiscard]] std::optional<InverseDepth> fit_from(std::size_t through, const Step& a,
                                                     const Step& b) const {
    const WindowPixel& first = pixels_[through];
    const WindowPixel *second = at(first, a), *third = at(first, b);
    if (second == nullptr || third == nullptr) return std::nullopt;
    Eigen::Matrix3d places;
    places << first.place.transpose(), second->place.transpose(), third->place.transpose();
    std::optional<InverseDepth> plane = places.inverse() * Vector3d(1 / first.z, 1 / second->z, 1 / third->z);
    for (const double units : {8.0, 4.0, 2.0, 1.0})
      if (plane) plane = fit_near(*plane, units);
    return plane;
  }

  /// Least squares of the depths, linear in the plane with z measured: (z^2 (plane . place) - z)^2.
  [[nodiscard]] std::optional<InverseDepth> fit_near(const InverseDepth& plane, double units) const {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Vector3d right = Vector3d::Zero();
    int count = 0;
    for (const WindowPixel& pixel : pixels_) {
      if (!is_on(plane, pixel, units)) continue;
      const double weight = pixel.z * pixel.z;
      normal += weight * weight * pixel.place * pixel.place.transpose();
      right += weight * pixel.z * pixel.place;
      ++count;
    }
    if (count < kFewestPixels) return std::nullopt;
    const Eigen::LDLT<Eigen::Matrix3d> factor(normal);
    const InverseDepth fitted = factor.solve(right);
    return factor.rcond() > kLeastRcond && fitted.allFinite() ? std::optional(fitted) : std::nullopt;
  }

  double unit_;
  int u_, v_, half_;
  std::vector<int> index_;  // into pixels_ by row and column, -1 if the depth is not known
  std::vector<WindowPixel> pixels_;
};

}  // namespace

std::vector<Plane> find_surfaces(const RawDepthImage& depth, const Camera& camera, const Vector2d& pixel,
                                 const SurfaceOptions& options) {
  require(camera.model == CameraModel::pinhole, "true surfaces are seen by a pinhole camera");
  require(options.units_per_metre > 0 && options.half_window >= 2, "the options are in their ranges");
  if (!pixel.allFinite() || !camera.contains(pixel)) return {};
  Window window(depth, pixel, options);
  std::vector<Plane> planes;
  for (const std::size_t near : window.within(options.reach_px)) {
    if (window.is_taken(near)) continue;
    if (const auto plane = window.take_plane(near)) planes.push_back(window.in_camera(*plane, camera));
  }
  return planes;
}

}  // namespace cairn
