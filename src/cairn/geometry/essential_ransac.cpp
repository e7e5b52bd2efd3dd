// SPDX-License-Identifier: Apache-2.0
#include "cairn/geometry/essential_ransac.h"

#include <cmath>

#include "cairn/geometry/five_point.h"
#include "cairn/geometry/inlier_limits.h"
#include "cairn/geometry/point_pairs.h"

namespace cairn {
namespace {

struct EssentialProblem {
  using Model = Eigen::Matrix3d;
  static constexpr std::size_t kSampleSize = 5, kMaxModels = 10;

  std::span<const Eigen::Vector2d> a, b;
  double sigma = 1;
  double information = 1 / (sigma * sigma);

  [[nodiscard]] std::size_t size() const { return a.size(); }

  std::size_t solve(const std::array<std::uint32_t, kSampleSize>& sample,
                    std::array<Model, kMaxModels>& models) const {
    std::array<Eigen::Vector2d, kSampleSize> in_a, in_b;
    for (std::size_t i = 0; i < kSampleSize; ++i) {
      in_a[i] = a[sample[i]];
      in_b[i] = b[sample[i]];
    }
    const FivePointSolutions solutions = solve_five_point(in_a, in_b);
    models = solutions.essential;
    return solutions.count;
  }

  [[nodiscard]] double squared_error(const Model& E, std::size_t i) const {
    return information * sampson_error(E, a[i], b[i]);
  }
  [[nodiscard]] static double limit(std::size_t /*i*/) { return kInlierLimit1; }

  bool refine(std::span<const std::int32_t> inliers, Model& E) const {
    constexpr int kIterations = 5;
    Rigid3 b_from_a = decompose_essential(E).candidates()[0];
    if (!refine_essential(a, b, inliers, kIterations, b_from_a)) return false;
    E = essential_of(b_from_a);
    return true;
  }

  /// A wrong b lies within the limit of its epipolar line, at most as long as the diagonal of where points
  /// lie (Moisan and Stival 2004, sec. 4.2); half of the squared Sampson distance is made up in a.
  [[nodiscard]] double chance() const {
    const PlaneExtent extent = extent_of(b);
    return 2.0 * extent.diagonal * sigma * std::sqrt(2.0 * kInlierLimit1) / extent.area;
  }
};

}  // namespace

RansacResult<Eigen::Matrix3d> find_essential(std::span<const Eigen::Vector2d> a,
                                             std::span<const Eigen::Vector2d> b, double sigma,
                                             const RansacOptions& options) {
  require_point_pairs(a, b, sigma);
  const EssentialProblem problem{a, b, sigma};
  return Ransac(problem, options).run();
}

}  // namespace cairn
