// SPDX-License-Identifier: Apache-2.0
#include "cairn/optimize/bundle_structure.h"

#include <algorithm>
#include <numeric>

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

/// Positions sorted by key_of, a number in [0, count); equal keys keep their order.
template <class KeyOf>
std::vector<std::size_t> sort_by(const std::vector<std::size_t>& positions, std::size_t count,
                                 const KeyOf& key_of) {
  std::vector<std::int32_t> keys;
  keys.reserve(positions.size());
  for (const std::size_t position : positions) keys.push_back(key_of(position));
  std::vector<std::size_t> sorted = group_items(keys, count).members;
  for (std::size_t& member : sorted) member = positions[member];
  return sorted;
}

/// The observations' positions: points by their first camera, within a point by camera. Then what one camera
/// sees lies together in memory.
std::vector<std::size_t> sort_observations(const BundleProblem& problem,
                                           const std::vector<std::int32_t>& ranks) {
  const auto& observations = problem.observations;
  const std::size_t points = problem.points_in_world.size();
  std::vector<std::size_t> order(observations.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto point_of = [&](std::size_t i) { return observations[i].point; };
  const auto rank_of = [&](std::size_t i) { return ranks[static_cast<std::size_t>(observations[i].camera)]; };
  order = sort_by(sort_by(order, points, point_of), ranks.size(), rank_of);
  std::vector<std::int32_t> place_of(points, -1);
  std::int32_t next = 0;
  for (const std::size_t i : order) {
    std::int32_t& place = place_of[static_cast<std::size_t>(point_of(i))];
    if (place < 0) place = next++;
  }
  return sort_by(order, points,
                 [&](std::size_t i) { return place_of[static_cast<std::size_t>(point_of(i))]; });
}

/// Returns the priors by rank of their camera; one without information where there is none.
std::vector<CameraPrior> priors_by_rank(const BundleProblem& problem, const std::vector<std::int32_t>& ranks,
                                        std::size_t free_count) {
  std::vector<CameraPrior> priors(ranks.size());
  std::vector<char> has_prior(ranks.size());
  for (const CameraPrior& prior : problem.priors) {
    const auto rank = static_cast<std::size_t>(ranks[static_cast<std::size_t>(prior.camera)]);
    require(has_prior[rank] == 0, "a camera has one prior at most");
    has_prior[rank] = 1;
    priors[rank] = prior;
  }
  priors.resize(free_count);
  return priors;
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
  for (const CameraPrior& prior : problem.priors) {
    require(prior.camera >= 0 && prior.camera < cameras, "a prior is of a camera");
    require(is_finite(prior.camera_from_world) && prior.information.allFinite(), "a prior is finite");
  }
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
  for (const std::size_t i : sort_observations(problem, ranks)) {
    const BundleObservation& observation = problem.observations[i];
    if (structure.points.empty() || structure.points.back() != observation.point)
      structure.begin_point(observation.point);
    else
      require(structure.terms.back().camera != observation.camera, "a camera sees a point at most once");
    structure.terms.push_back(make_term(observation));
    const std::int32_t rank = ranks[static_cast<std::size_t>(observation.camera)];
    if (rank >= static_cast<std::int32_t>(free_count)) continue;
    structure.link_free.push_back(rank);
    structure.link_point.push_back(static_cast<std::int32_t>(structure.points.size()) - 1);
  }
  structure.term_begin.push_back(structure.terms.size());
  structure.link_begin.push_back(structure.link_free.size());
  structure.links_of_free = group_items(structure.link_free, free_count);
  structure.prior_of_free = priors_by_rank(problem, ranks, free_count);
  return structure;
}

void BundleStructure::begin_point(std::int32_t point) {
  points.push_back(point);
  term_begin.push_back(terms.size());
  link_begin.push_back(link_free.size());
}

}  // namespace cairn
