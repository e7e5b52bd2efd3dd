// SPDX-License-Identifier: Apache-2.0
#include "cairn/observe/prediction.h"

#include <algorithm>
#include <cstring>

namespace cairn {
namespace {

constexpr double kMinViewCosine = 0.5;     // 60 degrees: descriptors rarely survive more
constexpr double kMaxDistanceRatio = 5.0;  // beyond, no pyramid level shows the same patch
constexpr double kMaxSizeRatio = 1.5;      // of found to expected: two levels of ORB's pyramid

}  // namespace

std::optional<SearchWindow> predict_window(const PosedFrame& view, const Eigen::Vector3d& point_in_world,
                                           const Appearance& appearance, double radius_px) {
  constexpr double kMinDepth = 1e-3;  // metres
  const Eigen::Vector3d point = view.camera_from_world * point_in_world;
  if (!(point.z() > kMinDepth)) return std::nullopt;
  const Eigen::Vector3d ray_then = point_in_world - appearance.centre_in_world;
  const Eigen::Vector3d ray_now = view.camera_from_world.rotation.conjugate() * point;
  const double distance_then = ray_then.norm(), distance_now = ray_now.norm();
  if (!(ray_then.dot(ray_now) > kMinViewCosine * distance_then * distance_now)) return std::nullopt;
  const double ratio = distance_then / distance_now;
  if (!(ratio < kMaxDistanceRatio && ratio * kMaxDistanceRatio > 1)) return std::nullopt;
  const Eigen::Vector3d pixel = view.rig.project(point);
  const double size = ratio * static_cast<double>(appearance.keypoint.size);
  const double sigma = std::max(1.0, ratio * static_cast<double>(appearance.keypoint.sigma_px));
  return SearchWindow{pixel.x(), pixel.y(), radius_px * sigma, size / kMaxSizeRatio, size * kMaxSizeRatio};
}

Descriptors gather(std::span<const Appearance> appearances) {
  if (appearances.empty()) return {};
  const Descriptors& kind = *appearances.front().descriptors;
  Descriptors rows(kind.norm(), kind.bytes(), appearances.size());
  for (std::size_t i = 0; i < appearances.size(); ++i)
    std::memcpy(rows.row(i), appearances[i].descriptors->row(appearances[i].row), rows.stride());
  return rows;
}

}  // namespace cairn
