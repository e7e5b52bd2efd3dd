// SPDX-License-Identifier: Apache-2.0
#include "cairn/geometry/alignment_ransac.h"

#include <cmath>
#include <numbers>

#include "cairn/core/error.h"
#include "cairn/geometry/inlier_limits.h"

namespace cairn {
namespace {

using Points = std::span<const Eigen::Vector3d>;

struct AlignmentProblem {
  using Model = Similarity3;
  static constexpr std::size_t kSampleSize = 3, kMaxModels = 1;

  Points source, target;
  bool with_scale = false;
  double sigma = 1;

  [[nodiscard]] std::size_t size() const { return source.size(); }

  template <class Indices>
  bool fit(const Indices& used, Model& model) const {
    std::vector<Eigen::Vector3d> from, to;
    for (const auto index : used) {
      from.push_back(source[static_cast<std::size_t>(index)]);
      to.push_back(target[static_cast<std::size_t>(index)]);
    }
    const Alignment alignment = align_points(from, to, with_scale);
    if (alignment.status != AlignmentStatus::ok) return false;
    model = alignment.target_from_source;
    return true;
  }

  std::size_t solve(const std::array<std::uint32_t, kSampleSize>& sample,
                    std::array<Model, kMaxModels>& models) const {
    return fit(sample, models[0]) ? 1 : 0;
  }
  [[nodiscard]] double squared_error(const Model& target_from_source, std::size_t i) const {
    return (target[i] - target_from_source * source[i]).squaredNorm() / (sigma * sigma);
  }
  [[nodiscard]] static double limit(std::size_t /*i*/) { return kInlierLimit3; }
  bool refine(std::span<const std::int32_t> inliers, Model& model) const { return fit(inliers, model); }

  /// A wrong target lies in the ball around the place where the model has it, somewhere in the box around all
  /// targets; a flat box is taken to be as high as the ball.
  [[nodiscard]] double chance() const {
    Eigen::Array3d low = target[0].array(), high = low;
    for (const auto& point : target) {
      low = low.min(point.array());
      high = high.max(point.array());
    }
    const double radius = std::sqrt(kInlierLimit3) * sigma;
    return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius / (high - low).max(2.0 * radius).prod();
  }
};

}  // namespace

RansacResult<Similarity3> align_points_ransac(Points source, Points target, bool with_scale, double sigma,
                                              const RansacOptions& options) {
  require(sigma > 0 && sigma < 1e100, "the standard deviation is a number above 0");
  require(source.size() == target.size(), "points to align correspond by position");
  (void)align_points(source, target, with_scale);  // refuses coordinates that are no numbers
  const AlignmentProblem problem{source, target, with_scale, sigma};
  return Ransac(problem, options).run();
}

}  // namespace cairn
