// SPDX-License-Identifier: Apache-2.0
#include "cairn/geometry/pnp_ransac.h"

#include <algorithm>
#include <cmath>

#include "cairn/core/error.h"
#include "cairn/core/random.h"
#include "cairn/geometry/p3p.h"

namespace cairn {
namespace {

struct Problem {
  const Rig& rig;
  std::span<const Eigen::Vector3d> points;
  std::span<const Observation> seen;
};

std::array<std::uint32_t, 3> draw_three(Random& random, std::uint32_t count) {
  std::array<std::uint32_t, 3> sample{};
  for (std::size_t i = 0; i < 3; ++i) {
    do {
      sample[i] = random.index(count);
    } while (std::find(sample.begin(), sample.begin() + static_cast<std::ptrdiff_t>(i), sample[i]) !=
             sample.begin() + static_cast<std::ptrdiff_t>(i));
  }
  return sample;
}

P3pSolutions solve_sample(const Problem& problem, const std::array<std::uint32_t, 3>& sample) {
  std::array<Eigen::Vector3d, 3> points, rays;
  for (std::size_t i = 0; i < 3; ++i) {
    const Observation& seen = problem.seen[sample[i]];
    points[i] = problem.points[sample[i]];
    rays[i] = problem.rig.point_at(seen.u, seen.v, 1.0).normalized();
  }
  return solve_p3p(points, rays);
}

struct Score {
  double cost = 0;
  std::size_t inliers = 0;
};

/// Stops once the cost is no better than `best_cost`: most poses are wrong and say so early.
Score score_pose(const Problem& problem, const Rigid3& camera_from_world, double best_cost) {
  const Eigen::Matrix3d rotation = camera_from_world.matrix3();
  Score score;
  for (std::size_t i = 0; i < problem.points.size() && score.cost < best_cost; ++i) {
    const double limit = squared_error_limit(problem.seen[i]);
    const double error = squared_error(
        problem.rig, rotation * problem.points[i] + camera_from_world.translation, problem.seen[i]);
    score.inliers += error < limit ? 1 : 0;
    score.cost += std::min(error, limit);
  }
  return score;
}

/// Samples needed until one of three inliers has been drawn with the given confidence.
int samples_needed(std::size_t inliers, std::size_t count, const RansacOptions& options) {
  const double share = static_cast<double>(inliers) / static_cast<double>(count);
  const double good_sample = share * share * share;
  if (good_sample >= options.confidence) return 1;
  const double needed = std::log(1.0 - options.confidence) / std::log1p(-good_sample);
  return needed < options.max_iterations ? static_cast<int>(std::ceil(needed)) : options.max_iterations;
}

}  // namespace

PnpResult solve_pnp_ransac(const Rig& rig, std::span<const Eigen::Vector3d> points_in_world,
                           std::span<const Observation> seen, const RansacOptions& options) {
  require(points_in_world.size() == seen.size(), "each point has one observation");
  PnpResult result;
  if (points_in_world.size() < 4) return result;
  const Problem problem{rig, points_in_world, seen};
  Random random(options.seed);
  double best_cost = std::numeric_limits<double>::infinity();
  int needed = options.max_iterations;
  for (; result.iterations < needed; ++result.iterations) {
    const P3pSolutions solutions =
        solve_sample(problem, draw_three(random, static_cast<std::uint32_t>(seen.size())));
    for (int i = 0; i < solutions.count; ++i) {
      const Rigid3& candidate = solutions.camera_from_world[static_cast<std::size_t>(i)];
      const Score score = score_pose(problem, candidate, best_cost);
      if (score.cost >= best_cost) continue;
      best_cost = score.cost;
      result.camera_from_world = candidate;
      result.found = true;
      needed = samples_needed(score.inliers, seen.size(), options);
    }
  }
  if (!result.found) return result;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const double error = squared_error(rig, result.camera_from_world * points_in_world[i], seen[i]);
    if (error < squared_error_limit(seen[i])) result.inliers.push_back(static_cast<std::int32_t>(i));
  }
  return result;
}

}  // namespace cairn
