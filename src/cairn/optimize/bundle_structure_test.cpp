// SPDX-License-Identifier: Apache-2.0
#include "cairn/optimize/bundle_structure.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "cairn/core/error.h"

namespace cairn {
namespace {

using Positions = std::vector<std::int32_t>;

TEST(GroupItems, keeps_the_order_within_a_group) {
  const Groups groups = group_items(Positions{2, 0, 2, 3, 0}, 5);
  EXPECT_EQ(groups.begin, (std::vector<std::size_t>{0, 2, 2, 4, 5, 5}));
  EXPECT_EQ(groups.members, (std::vector<std::size_t>{1, 4, 0, 2, 3}));
  EXPECT_TRUE(groups.of(1).empty());
  EXPECT_EQ(groups.of(2)[1], 2U);
}

/// Camera 1 is fixed. Seen are, in order of camera and point: 0: 3, 4; 1: 0, 3; 2: 0, 4. Points 1, 2: not.
BundleProblem make_problem() {
  BundleProblem problem;
  problem.camera_from_world.resize(3);
  problem.camera_fixed = {0, 1, 0};
  problem.points_in_world.resize(5);
  problem.observations = {{2, 4, {}}, {1, 3, {}}, {0, 4, {}}, {0, 3, {}}, {1, 0, {}}, {2, 0, {}}};
  return problem;
}

void expect_structure(const BundleStructure& structure) {
  EXPECT_EQ(structure.free_cameras, (Positions{0, 2}));
  EXPECT_EQ(structure.points, (Positions{3, 4, 0}));
  Positions cameras;
  for (const BundleTerm& term : structure.terms) cameras.push_back(term.camera);
  EXPECT_EQ(cameras, (Positions{0, 1, 0, 2, 2, 1}));  // of each point the free ones first
  EXPECT_EQ(structure.term_begin, (std::vector<std::size_t>{0, 2, 4, 6}));
  EXPECT_EQ(structure.link_begin, (std::vector<std::size_t>{0, 1, 3, 4}));
  EXPECT_EQ(structure.link_free, (Positions{0, 0, 1, 1}));
  EXPECT_EQ(structure.link_point, (Positions{0, 1, 1, 2}));
  EXPECT_EQ(structure.links_of_free.members, (std::vector<std::size_t>{0, 1, 2, 3}));
}

TEST(BundleStructure, is_the_same_in_any_order_of_observations) {
  BundleProblem problem = make_problem();
  expect_structure(analyse_bundle(problem));
  std::reverse(problem.observations.begin(), problem.observations.end());
  expect_structure(analyse_bundle(problem));
}

TEST(BundleStructure, refuses_a_camera_that_sees_a_point_twice) {
  BundleProblem problem = make_problem();
  problem.observations.push_back({1, 3, {}});
  EXPECT_THROW((void)analyse_bundle(problem), PreconditionError);
}

}  // namespace
}  // namespace cairn
