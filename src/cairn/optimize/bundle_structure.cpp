// SPDX-License-Identifier: Apache-2.0
#include "cairn/optimize/bundle_structure.h"

#include <algorithm>
#include <cmath>

#include "cairn/core/error.h"
#include "cairn/geometry/pose_equations.h"

namespace cairn {
namespace {

bool is_finite(const Rigid3& pose) {
  return pose.rotation.coeffs().allFinite() && pose.translation.allFinite();
}

/// For each camera its position among the free ones; fixed cameras get those after them.
std::vector<std::int32_t> rank_cameras(const BundleProblem& problem, std::size_t free_count) {
  std::vector<std::int32_t> ranks;
  auto next_free = std::int32_t{0}, next_fixed = static_cast<std::int32_t>(free_count);
  for (const char fixed : problem.camera_fixed) ranks.push_back(fixed != 0 ? next_fixed++ : next_free++);
  return ranks;
}

std::vector<std::int32_t> find_free(const BundleProblem& problem) {
  std::vector<std::int32_t> free;
  for (std::size_t i = 0; i < problem.camera_fixed.size(); ++i) {
    if (problem.camera_fixed[i] == 0) free.push_back(static_cast<std::int32_t>(i));
  }
  return free;
}

/// The observations' positions by point, within a point by rank.
std::vector<std::size_t> sort_observations(const BundleProblem& problem,
                                           const std::vector<std::int32_t>& ranks) {
  std::vector<std::int32_t> keys;
  for (const auto& observation : problem.observations)
    keys.push_back(ranks[static_cast<std::size_t>(observation.camera)]);
  std::vector<std::size_t> order = group_items(keys, ranks.size()).members;
  for (std::size_t i = 0; i < order.size(); ++i) keys[i] = problem.observations[order[i]].point;
  std::vector<std::size_t> sorted;
  for (const std::size_t i : group_items(keys, problem.points_in_world.size()).members)
    sorted.push_back(order[i]);
  return sorted;
}

}  // namespace

Groups group_items(std::span<const std::int32_t> group_of, std::size_t count) {
  Groups groups;
  groups.begin.assign(count + 1, 0);
  for (const std::int32_t group : group_of) ++groups.begin[static_cast<std::size_t>(group) + 1];
  for (std::size_t g = 0; g < count; ++g) groups.begin[g + 1] += groups.begin[g];
  groups.members.resize(group_of.size());
  std::vector<std::size_t> next(groups.begin.begin(), groups.begin.end() - 1);
  for (std::size_t i = 0; i < group_of.size(); ++i)
    groups.members[next[static_cast<std::size_t>(group_of[i])]++] = i;
  return groups;
}

void require_bundle(const BundleProblem& problem) {
  const auto cameras = static_cast<std::int32_t>(problem.camera_from_world.size());
  const auto points = static_cast<std::int32_t>(problem.points_in_world.size());
  require(problem.camera_fixed.size() == problem.camera_from_world.size(),
          "camera_fixed has one for each camera");
  require(problem.rig.fx > 0 && problem.rig.fy > 0 && problem.rig.baseline > 0,
          "focal lengths and baseline are above 0");
  require(std::all_of(problem.camera_from_world.begin(), problem.camera_from_world.end(), is_finite),
          "poses are finite");
  require(std::all_of(problem.points_in_world.begin(), problem.points_in_world.end(),
                      [](const Eigen::Vector3d& point) { return point.allFinite(); }),
          "points are finite");
  for (const BundleObservation& observation : problem.observations) {
    require(observation.camera >= 0 && observation.camera < cameras, "an observation is of a camera");
    require(observation.point >= 0 && observation.point < points, "an observation is of a point");
    require(is_usable(observation.seen), "pixels are finite and sigmas above 0");
  }
}

BundleStructure analyse_bundle(const BundleProblem& problem) {
  BundleStructure structure;
  structure.free_cameras = find_free(problem);
  const std::size_t free_count = structure.free_cameras.size();
  const std::vector<std::int32_t> ranks = rank_cameras(problem, free_count);
  structure.term_begin.assign(problem.points_in_world.size() + 1, 0);
  structure.link_begin = structure.term_begin;
  std::int32_t last_point = -1, last_camera = -1;
  for (const std::size_t i : sort_observations(problem, ranks)) {
    const BundleObservation& observation = problem.observations[i];
    require(observation.point != last_point || observation.camera != last_camera,
            "a camera sees a point at most once");
    last_point = observation.point, last_camera = observation.camera;
    structure.terms.push_back(make_term(observation));
    ++structure.term_begin[static_cast<std::size_t>(last_point) + 1];
    const std::int32_t rank = ranks[static_cast<std::size_t>(last_camera)];
    if (rank >= static_cast<std::int32_t>(free_count)) continue;
    ++structure.link_begin[static_cast<std::size_t>(last_point) + 1];
    structure.link_free.push_back(rank);
    structure.link_point.push_back(last_point);
  }
  for (std::size_t j = 0; j < structure.points(); ++j) {
    structure.term_begin[j + 1] += structure.term_begin[j];
    structure.link_begin[j + 1] += structure.link_begin[j];
  }
  structure.links_of_free = group_items(structure.link_free, free_count);
  return structure;
}

}  // namespace cairn
