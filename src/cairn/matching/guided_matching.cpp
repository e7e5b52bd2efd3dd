// SPDX-License-Identifier: Apache-2.0
#include "cairn/matching/guided_matching.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>

#include "cairn/core/error.h"
#include "cairn/features/keypoint_grid.h"
#include "cairn/matching/matching_candidates.h"
#include "cairn/matching/packed_descriptors.h"

namespace cairn {
namespace {

bool is_usable(const Keypoint& keypoint) {
  return std::isfinite(keypoint.u) && std::isfinite(keypoint.v) && std::isfinite(keypoint.size) &&
         std::isfinite(keypoint.sigma_px);
}

Eigen::Matrix3d intrinsics(const Camera& camera) {
  Eigen::Matrix3d K;
  K << camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1;
  return K;
}

/// The pixels of the train that a query's ray projects to: at_infinity + inverse_depth * per_inverse_depth,
/// homogeneous.
struct EpipolarCurve {
  Eigen::Vector3d at_infinity, per_inverse_depth;

  /// a u + b v + c = 0 with a^2 + b^2 = 1; zeros where the curve is a point.
  [[nodiscard]] Eigen::Vector3f line() const {
    const Eigen::Vector3d line = at_infinity.cross(per_inverse_depth);
    const double length = line.head<2>().norm();
    return length > 0 ? Eigen::Vector3f((line / length).cast<float>()) : Eigen::Vector3f::Zero();
  }

  /// Inverse depth, in [low, high], of the curve's point at a pixel: least squares of the two equations
  /// u (a2 + r b2) = a0 + r b0 and v (a2 + r b2) = a1 + r b1.
  [[nodiscard]] double inverse_depth_at(double u, double v, double low, double high) const {
    const Eigen::Vector3d &a = at_infinity, &b = per_inverse_depth;
    const double slope_u = u * b.z() - b.x(), slope_v = v * b.z() - b.y();
    const double squares = slope_u * slope_u + slope_v * slope_v;
    const double product = slope_u * (a.x() - u * a.z()) + slope_v * (a.y() - v * a.z());
    return squares > 0 ? std::clamp(product / squares, low, high) : low;
  }

  /// Distance of a pixel from the curve's point at an inverse depth; nothing where that is not in front.
  [[nodiscard]] std::optional<double> distance(double u, double v, double inverse_depth) const {
    const Eigen::Vector3d point = at_infinity + inverse_depth * per_inverse_depth;
    if (!(point.z() > 0)) return std::nullopt;
    return std::hypot(point.x() / point.z() - u, point.y() / point.z() - v);
  }
};

/// Train keypoints, each quantity by itself: most are looked at only to be passed over.
struct Columns {
  explicit Columns(const std::vector<Keypoint>& keypoints) {
    for (std::size_t i = 0; i < keypoints.size(); ++i) {
      if (!is_usable(keypoints[i])) continue;
      index.push_back(static_cast<std::int32_t>(i));
      u.push_back(keypoints[i].u), v.push_back(keypoints[i].v);
      size.push_back(keypoints[i].size), sigma.push_back(keypoints[i].sigma_px);
    }
  }
  std::vector<std::int32_t> index;
  std::vector<float> u, v, size, sigma;
};

/// Finds the trains that a query may match.
class EpipolarSearch {
 public:
  EpipolarSearch(const CameraFeatures& query, const CameraFeatures& train, const Rigid3& train_from_query,
                 const EpipolarMatchOptions& options)
      : query_(query.features),
        train_(train.features),
        ray_of_pixel_(intrinsics(query.camera).inverse()),
        at_infinity_(intrinsics(train.camera) * train_from_query.matrix3()),
        per_inverse_depth_(intrinsics(train.camera) * train_from_query.translation),
        options_(options),
        columns_(train.features.keypoints) {}

  void find(std::size_t q, Candidates& candidates) const {
    const Keypoint& keypoint = query_.keypoints[q];
    if (!is_usable(keypoint)) return;
    const Eigen::Vector3d pixel(static_cast<double>(keypoint.u), static_cast<double>(keypoint.v), 1);
    const EpipolarCurve curve{at_infinity_ * (ray_of_pixel_ * pixel), per_inverse_depth_};
    candidates.flags.resize(columns_.index.size());
    flag(keypoint, curve.line(), candidates.flags);
    for (std::size_t i = 0; i < candidates.flags.size(); ++i)
      if (candidates.flags[i] != 0 && is_on(curve, keypoint, i))
        candidates.trains.push_back(columns_.index[i]);
    candidates.measure(query_.descriptors, q, train_.descriptors);
  }

 private:
  /// flags[i] = 1 for those near the line and of like size. A plain loop that works on several at once; it
  /// lets a pixel more through than is_on does, as floats are not exact.
  void flag(const Keypoint& query, const Eigen::Vector3f& line, std::vector<std::uint32_t>& flags) const {
    constexpr float kSlack = 1;
    const float a = line.x(), b = line.y(), c = line.z();
    const auto band = static_cast<float>(options_.band_px),
               ratio = static_cast<float>(options_.max_size_ratio);
    const float *u = columns_.u.data(), *v = columns_.v.data();
    const float *size = columns_.size.data(), *sigma = columns_.sigma.data();
    std::uint32_t* flag = flags.data();
    for (std::size_t i = 0; i < flags.size(); ++i) {
      const float reach = band * (sigma[i] > query.sigma_px ? sigma[i] : query.sigma_px) + kSlack;
      const bool near_line = std::abs(a * u[i] + b * v[i] + c) <= reach;
      const bool alike = (size[i] <= ratio * query.size) & (query.size <= ratio * size[i]);
      flag[i] = (near_line & alike) ? 1 : 0;
    }
  }

  [[nodiscard]] bool is_on(const EpipolarCurve& curve, const Keypoint& query, std::size_t i) const {
    const auto u = static_cast<double>(columns_.u[i]), v = static_cast<double>(columns_.v[i]);
    const double low = 1 / options_.max_depth;
    const double high = options_.min_depth > 0 ? 1 / options_.min_depth : std::numeric_limits<double>::max();
    const auto distance = curve.distance(u, v, curve.inverse_depth_at(u, v, low, high));
    const auto sigma = static_cast<double>(std::max(query.sigma_px, columns_.sigma[i]));
    return distance && *distance <= options_.band_px * sigma;
  }

  const Features& query_;
  const Features& train_;
  Eigen::Matrix3d ray_of_pixel_, at_infinity_;
  Eigen::Vector3d per_inverse_depth_;
  const EpipolarMatchOptions& options_;
  Columns columns_;
};

}  // namespace

void EpipolarMatchOptions::validate() const {
  require(band_px >= 0 && std::isfinite(band_px), "the band is not negative");
  require(min_depth >= 0 && max_depth > min_depth, "the depth limits are not negative and ascend");
  require(max_size_ratio >= 1, "sizes may be equal");
  matching.validate();
}

std::vector<Match> match_along_epipolar_lines(const CameraFeatures& query, const CameraFeatures& train,
                                              const Rigid3& train_from_query,
                                              const EpipolarMatchOptions& options, const Executor& executor) {
  options.validate();
  require(query.camera.model == CameraModel::pinhole && train.camera.model == CameraModel::pinhole,
          "both cameras are pinholes");
  if (query.features.keypoints.empty() || train.features.keypoints.empty()) return {};
  require_comparable(query.features.descriptors, train.features.descriptors);
  const EpipolarSearch search(query, train, train_from_query, options);
  return without_gaps(match_candidates(
      query.features.keypoints.size(), train.features.keypoints.size(), query.features.descriptors.norm(),
      [&](std::size_t q, Candidates& candidates) { search.find(q, candidates); }, options.matching,
      executor));
}

std::vector<Match> match_predicted(const std::vector<SearchWindow>& places, const Descriptors& descriptors,
                                   const Features& features, const MatchOptions& options,
                                   const Executor& executor) {
  options.validate();
  require(places.size() == descriptors.count(), "each place has a descriptor");
  if (places.empty() || features.keypoints.empty()) return {};
  require_comparable(descriptors, features.descriptors);
  const KeypointGrid grid(features.keypoints);
  const auto find = [&](std::size_t p, Candidates& candidates) {
    const SearchWindow& place = places[p];
    grid.find(place.u, place.v, place.radius_px, candidates.trains);
    std::erase_if(candidates.trains, [&](std::int32_t i) {
      const auto size = static_cast<double>(features.keypoints[static_cast<std::size_t>(i)].size);
      return !(size >= place.min_size && size <= place.max_size);
    });
    candidates.measure(descriptors, p, features.descriptors);
  };
  return without_gaps(match_candidates(places.size(), features.keypoints.size(), descriptors.norm(), find,
                                       options, executor));
}

}  // namespace cairn
