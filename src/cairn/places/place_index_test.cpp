// SPDX-License-Identifier: Apache-2.0
#include "cairn/places/place_index.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "cairn/core/error.h"
#include "cairn/core/random.h"

namespace cairn {
namespace {

Descriptors random_descriptors(Norm norm, std::size_t bytes, std::size_t count, std::uint64_t seed) {
  Random random(seed);
  Descriptors descriptors(norm, bytes, count);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t b = 0; b < bytes; ++b)
      descriptors.row(i)[b] = static_cast<std::uint8_t>(random.index(256));
  return descriptors;
}

Descriptors random_descriptors(std::size_t count, std::uint64_t seed) {
  return random_descriptors(Norm::hamming, 32, count, seed);
}

/// Some rows of some descriptors, one after the other.
struct Part {
  const Descriptors& of;
  std::size_t first, count;
};

Descriptors join(const std::vector<Part>& parts) {
  std::size_t count = 0;
  for (const Part& part : parts) count += part.count;
  const Descriptors& kind = parts.front().of;
  Descriptors joined(kind.norm(), kind.bytes(), count);
  std::size_t at = 0;
  for (const Part& part : parts)
    for (std::size_t i = 0; i < part.count; ++i)
      std::memcpy(joined.row(at++), part.of.row(part.first + i), kind.bytes());
  return joined;
}

/// Every tenth bit, or a change of a value as large, in half of the rows; the others are of something else.
Descriptors seen_again(const Descriptors& descriptors, std::uint64_t seed) {
  Random random(seed);
  Descriptors again = random_descriptors(descriptors.norm(), descriptors.bytes(), descriptors.count(), seed);
  for (std::size_t i = 0; i < descriptors.count(); i += 2)
    for (std::size_t b = 0; b < descriptors.bytes(); ++b) {
      const bool changed = random.uniform() < 0.8;
      again.row(i)[b] =
          static_cast<std::uint8_t>(descriptors.row(i)[b] ^ (changed ? 1U << random.index(8) : 0U));
    }
  return again;
}

std::vector<std::int32_t> ids(const std::vector<PlaceCandidate>& candidates) {
  std::vector<std::int32_t> result;
  for (const PlaceCandidate& candidate : candidates) result.push_back(candidate.id);
  return result;
}

struct Kind {
  Norm norm;
  std::size_t bytes;
};
class PlaceIndexOfEachKind : public testing::TestWithParam<Kind> {};
INSTANTIATE_TEST_SUITE_P(PlaceIndex, PlaceIndexOfEachKind,
                         testing::Values(Kind{Norm::hamming, 32}, Kind{Norm::hamming, 61},
                                         Kind{Norm::l2, 128}));

TEST_P(PlaceIndexOfEachKind, finds_what_is_seen_again) {
  constexpr std::int32_t kKeyframes = 60;
  const auto keyframe = [](std::int32_t id) {
    return random_descriptors(GetParam().norm, GetParam().bytes, 200, static_cast<std::uint64_t>(id));
  };
  PlaceIndex index;
  for (std::int32_t id = 0; id < kKeyframes; ++id) index.add(id, keyframe(id));
  for (std::int32_t id = 0; id < kKeyframes; id += 7) {
    const auto found = index.query(seen_again(keyframe(id), 1000), 3);
    ASSERT_FALSE(found.empty());
    EXPECT_EQ(found[0].id, id);
    EXPECT_GT(found[0].score, 0.05);
    EXPECT_LE(found[0].score, 0.5 + 1e-9);  // half of the rows were seen again
    if (found.size() > 1) {
      EXPECT_LT(found[1].score, found[0].score / 5);
    }
  }
}

TEST_P(PlaceIndexOfEachKind, the_same_image_scores_one) {
  PlaceIndex index;
  const auto image = random_descriptors(GetParam().norm, GetParam().bytes, 500, 1);
  index.add(7, image);
  index.add(8, random_descriptors(GetParam().norm, GetParam().bytes, 500, 2));
  const auto found = index.query(image, 1);
  ASSERT_EQ(ids(found), std::vector<std::int32_t>{7});
  EXPECT_NEAR(found[0].score, 1, 1e-12);
}

TEST(PlaceIndex, texture_that_is_everywhere_weighs_little) {
  const auto common = random_descriptors(50, 1), rare = random_descriptors(10, 2);
  PlaceIndex index;
  for (std::int32_t id = 0; id < 30; ++id)
    index.add(id,
              join({{common, 0, 50}, {random_descriptors(20, 100 + static_cast<std::uint64_t>(id)), 0, 20}}));
  index.add(30, join({{rare, 0, 10}, {random_descriptors(60, 3), 0, 60}}));
  const auto found = index.query(join({{common, 0, 50}, {rare, 0, 10}}), 100);
  ASSERT_EQ(found.size(), 31U);
  EXPECT_EQ(found[0].id, 30);  // 10 that nobody else has go before 50 that all have
  EXPECT_GT(found[0].score, 5 * found[1].score);
}

TEST(PlaceIndex, what_is_seen_once_counts_once) {
  const auto things = random_descriptors(3, 1);
  std::vector<Part> copies(50, Part{things, 0, 1});
  PlaceIndex index;
  index.add(1, join(copies));                                                // one thing, many times
  index.add(2, join({{things, 1, 2}, {random_descriptors(48, 2), 0, 48}}));  // two things
  index.add(3, random_descriptors(50, 3));
  EXPECT_EQ(ids(index.query(things, 5)), (std::vector<std::int32_t>{2, 1}));
  // And so it is where the query repeats itself.
  copies.push_back({things, 1, 2});
  EXPECT_EQ(ids(index.query(join(copies), 5)), (std::vector<std::int32_t>{2, 1}));
}

TEST(PlaceIndex, gives_only_what_is_admitted_and_at_most_what_is_asked_for) {
  const auto image = random_descriptors(100, 1);
  PlaceIndex index;
  for (std::int32_t id = 0; id < 10; ++id)
    index.add(id, seen_again(image, static_cast<std::uint64_t>(id) + 2));
  EXPECT_EQ(index.query(image, 100).size(), 10U);
  EXPECT_EQ(index.query(image, 3).size(), 3U);
  EXPECT_TRUE(index.query(image, 0).empty());
  const auto found = ids(index.query(image, 100, [](std::int32_t id) { return id % 4 == 1; }));
  EXPECT_EQ(found.size(), 3U);
  for (const std::int32_t id : found) EXPECT_EQ(id % 4, 1);
  EXPECT_TRUE(index.query(image, 100, [](std::int32_t) { return false; }).empty());
}

TEST(PlaceIndex, what_is_not_admitted_does_not_change_the_scores) {
  const auto image = random_descriptors(20, 1);
  PlaceIndex index;
  for (std::int32_t id = 0; id < 4; ++id)
    index.add(id, seen_again(image, static_cast<std::uint64_t>(id) + 2));
  const auto before = index.query(image, 10);
  for (std::int32_t id = 4; id < 6; ++id) index.add(id, image);  // few enough that no leaf is cut
  const auto after = index.query(image, 10, [](std::int32_t id) { return id < 4; });
  EXPECT_EQ(before.size(), 4U);
  EXPECT_EQ(after, before);
}

TEST(PlaceIndex, of_equal_scores_the_lower_id_is_first) {
  const auto image = random_descriptors(100, 1);
  PlaceIndex index;
  for (const std::int32_t id : {9, 2, 30, 4}) index.add(id, image);
  const auto found = index.query(image, 3);
  EXPECT_EQ(ids(found), (std::vector<std::int32_t>{2, 4, 9}));
  EXPECT_EQ(found[0].score, found[2].score);
}

TEST(PlaceIndex, forgets_what_is_removed) {
  PlaceIndex index;
  const auto keyframe = [](std::int32_t id) {
    return random_descriptors(100, static_cast<std::uint64_t>(id));
  };
  for (std::int32_t id = 0; id < 40; ++id) index.add(id, keyframe(id));
  for (std::int32_t id = 0; id < 40; ++id) {  // across the pass over the tree at half of them
    if (id % 8 != 0) index.remove(id);
    EXPECT_EQ(index.contains(id), id % 8 == 0);
  }
  EXPECT_EQ(index.size(), 5U);
  for (std::int32_t id = 0; id < 40; ++id) {
    const auto found = ids(index.query(keyframe(id), 40));
    EXPECT_EQ(std::find(found.begin(), found.end(), id) != found.end(), id % 8 == 0) << id;
    for (const std::int32_t other : found) EXPECT_EQ(other % 8, 0);
  }
  index.add(1, keyframe(50));  // the id may come again, and shows something else
  EXPECT_EQ(ids(index.query(keyframe(50), 1)), std::vector<std::int32_t>{1});
  for (const std::int32_t id : {0, 8, 16, 24, 32, 1}) index.remove(id);
  EXPECT_EQ(index.size(), 0U);
  EXPECT_TRUE(index.query(keyframe(0), 10).empty());
}

TEST(PlaceIndex, few_or_no_descriptors_are_no_trouble) {
  PlaceIndex index;
  EXPECT_TRUE(index.query(random_descriptors(10, 1), 5).empty());
  index.add(1, Descriptors());
  EXPECT_TRUE(index.query(random_descriptors(10, 1), 5).empty());
  const auto one = random_descriptors(1, 2);
  index.add(2, one);
  index.add(3, Descriptors(Norm::l2, 128, 0));  // nothing, of whatever kind
  EXPECT_TRUE(index.query(Descriptors(), 5).empty());
  EXPECT_EQ(ids(index.query(one, 5)), std::vector<std::int32_t>{2});
  EXPECT_TRUE(index.query(random_descriptors(10, 1), 5).empty());
  index.remove(1);
  index.remove(2);
  EXPECT_EQ(index.size(), 1U);
}

TEST(PlaceIndex, keyframes_that_are_all_the_same_are_no_trouble) {
  const Descriptors image(Norm::hamming, 32, 300);
  PlaceIndex index;
  for (std::int32_t id = 0; id < 20; ++id) index.add(id, image);
  const auto found = index.query(image, 2);
  EXPECT_EQ(ids(found), (std::vector<std::int32_t>{0, 1}));
  EXPECT_TRUE(std::isfinite(found[0].score));
  EXPECT_LE(found[0].score, 1);
}

TEST(PlaceIndex, the_same_calls_give_the_same_bits) {
  const auto ask = [] {
    PlaceIndex index;
    for (std::int32_t id = 0; id < 50; ++id) {
      index.add(id, random_descriptors(150, static_cast<std::uint64_t>(id) % 10));
      if (id % 5 == 4) index.remove(id - 2);
    }
    return index.query(seen_again(random_descriptors(150, 3), 99), 50);
  };
  const auto found = ask();
  EXPECT_GT(found.size(), 2U);
  EXPECT_EQ(found, ask());
}

TEST(PlaceIndex, refuses_misuse) {
  PlaceIndex index;
  index.add(1, random_descriptors(10, 1));
  EXPECT_THROW(index.add(1, random_descriptors(10, 2)), PreconditionError);
  EXPECT_THROW(index.remove(2), PreconditionError);
  const auto others = random_descriptors(Norm::l2, 32, 10, 1);
  EXPECT_THROW(index.add(2, others), PreconditionError);
  EXPECT_FALSE(index.contains(2));
  EXPECT_THROW((void)index.query(others, 1), PreconditionError);
  EXPECT_THROW((void)index.query(random_descriptors(Norm::hamming, 61, 10, 1), 1), PreconditionError);
  EXPECT_THROW(PlaceIndex({.max_distance_share = -1}), PreconditionError);
  EXPECT_THROW(PlaceIndex({.max_distance_share = std::numeric_limits<double>::quiet_NaN()}),
               PreconditionError);
  EXPECT_THROW(PlaceIndex({.leaves_per_descriptor = 0}), PreconditionError);
  EXPECT_THROW(PlaceIndex({.tree = {.branching = 0}}), PreconditionError);
}

}  // namespace
}  // namespace cairn
