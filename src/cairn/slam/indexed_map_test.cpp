// SPDX-License-Identifier: Apache-2.0
#include "cairn/slam/indexed_map.h"

#include <gtest/gtest.h>

#include "cairn/core/error.h"
#include "cairn/testing/geometry/camera_paths.h"
#include "cairn/testing/map/point_world.h"

namespace cairn {
namespace {

/// Three keyframes of one world, the second of them erased.
IndexedMap three_keyframes() {
  const testkit::PointWorld world = testkit::points_ahead(200, 3);
  IndexedMap indexed(Map(testkit::kWorldRig, "ORB"));
  for (std::int32_t k = 0; k < 3; ++k)
    (void)indexed.add_keyframe(world.see(testkit::aside(0.1 * k), k).observed, testkit::aside(0.1 * k),
                               {k - 1}, 0);
  indexed.erase({1});
  return indexed;
}

void expect_in_step(const IndexedMap& indexed) {
  const std::vector<KeyframeId> ids = indexed.map().keyframe_ids();
  EXPECT_EQ(indexed.places().size(), ids.size());
  for (const KeyframeId id : ids) EXPECT_TRUE(indexed.places().contains(id.value));
}

TEST(IndexedMap, the_index_has_the_keyframes_that_are_not_erased) {
  const IndexedMap indexed = three_keyframes();
  EXPECT_EQ(indexed.map().keyframe_ids(), (std::vector<KeyframeId>{{0}, {2}}));
  expect_in_step(indexed);
}

TEST(IndexedMap, a_map_with_erased_keyframes_is_indexed) {
  IndexedMap first = three_keyframes();
  const IndexedMap again(first.release());
  EXPECT_EQ(again.map().keyframe_ids().size(), 2U);
  expect_in_step(again);
}

TEST(IndexedMap, a_keyframe_is_found_by_what_it_shows) {
  const IndexedMap indexed = three_keyframes();
  const auto found = indexed.places().query(indexed.map()[KeyframeId{2}].observed.features.descriptors, 1);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].id, 2);
}

TEST(IndexedMap, a_released_map_leaves_nothing) {
  IndexedMap indexed = three_keyframes();
  EXPECT_EQ(indexed.release().keyframes().size(), 3U);
  EXPECT_TRUE(indexed.map().keyframes().empty());
  EXPECT_EQ(indexed.places().size(), 0U);
}

TEST(IndexedMap, a_keyframe_is_erased_once) {
  IndexedMap indexed = three_keyframes();
  EXPECT_THROW(indexed.erase({1}), PreconditionError);
}

}  // namespace
}  // namespace cairn
