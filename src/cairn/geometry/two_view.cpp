// SPDX-License-Identifier: Apache-2.0
#include "cairn/geometry/two_view.h"

#include <algorithm>
#include <cmath>

#include "cairn/core/error.h"
#include "cairn/core/median.h"
#include "cairn/geometry/essential_ransac.h"
#include "cairn/geometry/homography.h"

namespace cairn {
namespace {

struct Views {
  std::span<const Eigen::Vector2d> a, b;
  const TwoViewOptions& options;
};

std::vector<TwoViewPoint> triangulate_all(const Views& views, std::span<const std::int32_t> inliers,
                                          const Rigid3& b_from_a) {
  std::vector<TwoViewPoint> points;
  for (const std::int32_t index : inliers) {
    const auto i = static_cast<std::size_t>(index);
    const auto point = triangulate(b_from_a, views.a[i], views.b[i], views.options.min_angle);
    if (point) points.push_back({index, *point});
  }
  return points;
}

/// Inliers whose rays meet at the options' angle or more. It depends on the rotation alone.
std::size_t count_parted(const Views& views, std::span<const std::int32_t> inliers,
                         const Eigen::Quaterniond& rotation) {
  std::size_t parted = 0;
  for (const std::int32_t index : inliers) {
    const auto i = static_cast<std::size_t>(index);
    const Eigen::Vector3d ray_a = rotation * views.a[i].homogeneous(), ray_b = views.b[i].homogeneous();
    const double angle = std::atan2(ray_a.cross(ray_b).norm(), ray_a.dot(ray_b));
    parted += angle >= views.options.min_angle ? 1 : 0;
  }
  return parted;
}

TwoViewStatus judge(const TwoViewResult& result, const TwoViewOptions& options) {
  const TwoViewMotion& best = result.motions[result.motion];
  constexpr std::size_t kFewest = 5;  // as many as a motion takes
  if (best.parted < kFewest) return TwoViewStatus::no_depth;
  std::size_t rival = 0;
  for (std::size_t i = 0; i < 4; ++i)
    if (i != result.motion) rival = std::max(rival, result.motions[i].in_front);
  const auto front = static_cast<double>(best.in_front);
  const bool clear = front >= options.min_in_front * static_cast<double>(best.parted) &&
                     static_cast<double>(rival) <= options.max_rival * front;
  return clear ? TwoViewStatus::ok : TwoViewStatus::ambiguous_motion;
}

/// The motion with most inliers in front of both cameras, and these.
void choose_motion(const Views& views, TwoViewResult& result) {
  const bool plane = result.choice.model == TwoViewModel::homography;
  const auto& inliers = plane ? result.homography.inliers : result.essential.inliers;
  const std::array<Rigid3, 4> candidates = plane ? decompose_homography(result.homography.model)
                                                 : decompose_essential(result.essential.model).candidates();
  for (std::size_t i = 0; i < 4; ++i) {
    TwoViewMotion& motion = result.motions[i];
    motion.b_from_a = BFromA({candidates[i].rotation, candidates[i].translation.normalized()});
    motion.parted = count_parted(views, inliers, motion.b_from_a.rotation);
    std::vector<TwoViewPoint> points = triangulate_all(views, inliers, motion.b_from_a);
    motion.in_front = points.size();
    if (i > 0 && motion.in_front <= result.motions[result.motion].in_front) continue;
    result.motion = i;
    result.points = std::move(points);
  }
  result.b_from_a = result.motions[result.motion].b_from_a;
  result.status = judge(result, views.options);
}

const Eigen::Matrix3d* model_of(const RansacResult<Eigen::Matrix3d>& result) {
  return result.found() ? &result.model : nullptr;
}

}  // namespace

std::string_view to_string(TwoViewStatus status) {
  switch (status) {
    case TwoViewStatus::too_few_points:
      return "fewer than five matches";
    case TwoViewStatus::no_model:
      return "no essential matrix and no homography that more matches agree with than would by chance";
    case TwoViewStatus::no_translation:
      return "the camera only turned, so there is no translation and no depth";
    case TwoViewStatus::ambiguous_motion:
      return "no motion, or more than one, has the points in front of both cameras";
    case TwoViewStatus::no_depth:
      return "the rays of too few matches meet at an angle that shows depth";
    case TwoViewStatus::ok:
      break;
  }
  return "ok";
}

TwoViewResult reconstruct_two_views(std::span<const Eigen::Vector2d> a, std::span<const Eigen::Vector2d> b,
                                    double sigma, const TwoViewOptions& options) {
  TwoViewResult result;
  result.essential = find_essential(a, b, sigma, options.ransac);
  result.homography = find_homography(a, b, sigma, options.ransac);
  if (result.essential.status == RansacStatus::too_few_data) return result;
  result.status = TwoViewStatus::no_model;
  if (!result.essential.found() && !result.homography.found()) return result;
  result.choice = choose_model(a, b, sigma, model_of(result.essential), model_of(result.homography));
  if (result.choice.model == TwoViewModel::rotation) {
    result.status = TwoViewStatus::no_translation;
    result.b_from_a.rotation = fit_rotation(a, b, result.homography.inliers);
    return result;
  }
  choose_motion({a, b, options}, result);
  return result;
}

MetricScale metric_scale(std::span<const TwoViewPoint> points, std::span<const double> depths_in_a) {
  require(points.size() == depths_in_a.size(), "each point has one measured depth");
  std::vector<double> ratios;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (depths_in_a[i] > 0) ratios.push_back(depths_in_a[i] / points[i].triangulated.point_in_a.z());
  MetricScale scale;
  scale.points = ratios.size();
  if (ratios.empty()) return scale;
  scale.metres_per_unit = median(ratios);
  for (double& ratio : ratios) ratio = std::abs(ratio - scale.metres_per_unit);
  scale.relative_mad = kSigmaPerMedian * median(ratios) / scale.metres_per_unit;
  return scale;
}

}  // namespace cairn
