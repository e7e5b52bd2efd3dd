// SPDX-License-Identifier: Apache-2.0
#include "cairn/geometry/rectification.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace cairn {
namespace {

constexpr double kMinBaseline = 1e-6;   // metres
constexpr double kMinForward = 0.1;     // of the mean optical axis, at a right angle to the baseline
constexpr double kMinResolution = 0.8;  // of the raw images' in the middle; README, "Calibration"

/// A part of the image plane at distance 1 of the rectified cameras.
struct BorderView {
  Eigen::Vector2d centre;
  double half_width;  ///< its height follows from the images' shape
};

/// What both cameras of a pair see, in directions (x, y, 1) of the rectified frame.
class CommonView {
 public:
  CommonView(const StereoPair& pair, const StereoRectification& rectification)
      : pair_(pair),
        left_from_rectified_(rectification.rectified_from_left.conjugate().toRotationMatrix()),
        right_from_rectified_(rectification.rectified_from_right.conjugate().toRotationMatrix()),
        height_over_width_(static_cast<double>(rectification.camera.height - 1) /
                           std::max(1, rectification.camera.width - 1)) {}

  /// The largest view with this centre whose border both cameras see; nothing where they do not see one of
  /// `half_width`.
  [[nodiscard]] std::optional<BorderView> around(const Eigen::Vector2d& centre, double half_width) const {
    BorderView view{centre, half_width};
    if (!sees_border(view)) return std::nullopt;
    constexpr int kHalvings = 40;
    constexpr double kWidest = 4;  // 76 degrees to each side; a pinhole image of more is all border
    double too_wide = kWidest;
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = 0.5 * (view.half_width + too_wide);
      (sees_border({centre, middle}) ? view.half_width : too_wide) = middle;
    }
    return view;
  }

 private:
  [[nodiscard]] bool sees(const Eigen::Vector2d& direction) const {
    return sees(pair_.left, left_from_rectified_, direction) &&
           sees(pair_.right, right_from_rectified_, direction);
  }
  [[nodiscard]] static bool sees(const Camera& camera, const Eigen::Matrix3d& camera_from_rectified,
                                 const Eigen::Vector2d& direction) {
    const auto pixel = camera.project(camera_from_rectified * direction.homogeneous());
    return pixel && camera.contains(*pixel);
  }
  [[nodiscard]] bool sees_border(const BorderView& view) const {
    constexpr int kSteps = 24;  // a side; between them images' borders are straight to a tenth of a pixel
    const Eigen::Vector2d half(view.half_width, view.half_width * height_over_width_);
    for (int i = 0; i <= kSteps; ++i) {
      const double s = 2.0 * i / kSteps - 1.0;
      for (const double side : {-1.0, 1.0}) {
        if (!sees(view.centre + Eigen::Vector2d(s, side).cwiseProduct(half))) return false;
        if (!sees(view.centre + Eigen::Vector2d(side, s).cwiseProduct(half))) return false;
      }
    }
    return true;
  }

  const StereoPair& pair_;
  Eigen::Matrix3d left_from_rectified_, right_from_rectified_;
  double height_over_width_;
};

/// The widest view: its centre is moved in four directions while that helps, in ever smaller steps.
std::optional<BorderView> widest_view(const CommonView& common, const Eigen::Vector2d& start) {
  constexpr double kFirstStep = 0.1, kLastStep = 1e-4;  // on the plane at distance 1: 6 and 0.006 degrees
  auto best = common.around(start, 0);
  for (double step = kFirstStep; best && step >= kLastStep;) {
    const BorderView from = *best;
    for (const Eigen::Vector2d& move : {Eigen::Vector2d(step, 0), Eigen::Vector2d(-step, 0),
                                        Eigen::Vector2d(0, step), Eigen::Vector2d(0, -step)}) {
      const auto moved = common.around(from.centre + move, best->half_width);
      if (moved && moved->half_width > best->half_width) best = moved;
    }
    if (best->half_width == from.half_width) step *= 0.5;
  }
  return best;
}

/// Axes of the rectified frame as the rows of rectified_from_left; nothing where there is no such frame.
std::optional<Eigen::Matrix3d> rectified_axes(const Rigid3& left_from_right) {
  const Eigen::Vector3d x = left_from_right.translation.normalized();
  const Eigen::Vector3d axes = Eigen::Vector3d::UnitZ() + left_from_right.rotation * Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d forward = 0.5 * (axes - x * x.dot(axes));
  if (!(forward.norm() > kMinForward)) return std::nullopt;
  const Eigen::Vector3d z = forward.normalized();
  Eigen::Matrix3d rows;
  rows << x.transpose(), z.cross(x).transpose(), z.transpose();
  return rows;
}

/// Where the middle of a raw image is seen in the rectified frame; nothing where that is not ahead.
std::optional<Eigen::Vector2d> middle_of(const Camera& camera, const Eigen::Quaterniond& rectified) {
  const auto ray = camera.unproject({0.5 * (camera.width - 1), 0.5 * (camera.height - 1)});
  if (!ray) return std::nullopt;
  const Eigen::Vector3d direction = rectified * ray->homogeneous();
  if (!(direction.z() > 0)) return std::nullopt;
  return direction.hnormalized();
}

/// Fills the camera's intrinsics; false where the two raw cameras have no view in common.
bool choose_intrinsics(const StereoPair& pair, StereoRectification& rectification) {
  const auto left = middle_of(pair.left, rectification.rectified_from_left);
  const auto right = middle_of(pair.right, rectification.rectified_from_right);
  if (!left || !right) return false;
  const auto view = widest_view(CommonView(pair, rectification), 0.5 * (*left + *right));
  if (!view || !(view->half_width > 0)) return false;
  Camera& camera = rectification.camera;
  const double half_width_px = 0.5 * std::max(1, camera.width - 1);
  const double raw_focal_length = std::pow(pair.left.fx * pair.left.fy * pair.right.fx * pair.right.fy, 0.25);
  camera.fx = camera.fy = std::max(half_width_px / view->half_width, kMinResolution * raw_focal_length);
  camera.cx = 0.5 * (camera.width - 1) - camera.fx * view->centre.x();
  camera.cy = 0.5 * (camera.height - 1) - camera.fy * view->centre.y();
  return true;
}

}  // namespace

StereoRectification rectify_stereo(const StereoPair& pair) {
  StereoRectification result;
  const Eigen::Vector3d& right_in_left = pair.left_from_right.translation;
  result.baseline = right_in_left.norm();
  const bool is_vertical = std::abs(right_in_left.y()) > std::abs(right_in_left.x());
  if (!(result.baseline > kMinBaseline) || !std::isfinite(result.baseline)) return result;
  result.status = RectificationStatus::right_is_left;
  if (!is_vertical && right_in_left.x() < 0) return result;
  result.status = RectificationStatus::no_common_view;
  const auto rectified_from_left = rectified_axes(pair.left_from_right);
  if (!rectified_from_left) return result;
  result.rectified_from_left = Eigen::Quaterniond(*rectified_from_left).normalized();
  result.rectified_from_right = (result.rectified_from_left * pair.left_from_right.rotation).normalized();
  result.camera.width = pair.left.width;
  result.camera.height = pair.left.height;
  if (is_vertical) std::swap(result.camera.width, result.camera.height);
  if (choose_intrinsics(pair, result)) result.status = RectificationStatus::ok;
  return result;
}

}  // namespace cairn
