// SPDX-License-Identifier: Apache-2.0
#include "cairn/places/descriptor_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <numeric>

#include "cairn/core/error.h"
#include "cairn/core/random.h"

namespace cairn {
namespace {

struct Kind {
  Norm norm;
  std::size_t bytes;
};

class EachKind : public testing::TestWithParam<Kind> {
 protected:
  [[nodiscard]] Descriptors random_descriptors(std::size_t count, std::uint64_t seed) const {
    Random random(seed);
    Descriptors descriptors(GetParam().norm, GetParam().bytes, count);
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t b = 0; b < descriptors.bytes(); ++b)
        descriptors.row(i)[b] = static_cast<std::uint8_t>(random.index(256));
    return descriptors;
  }
};

INSTANTIATE_TEST_SUITE_P(DescriptorTree, EachKind,
                         testing::Values(Kind{Norm::hamming, 32}, Kind{Norm::hamming, 61},
                                         Kind{Norm::l2, 128}, Kind{Norm::l2, 5}));

/// Owner i has row i.
DescriptorTree grow(const Descriptors& rows, const DescriptorTreeOptions& options = {}) {
  DescriptorTree tree(rows, options);
  for (std::size_t i = 0; i < rows.count(); ++i) tree.add(rows, i, static_cast<std::int32_t>(i));
  return tree;
}

std::vector<std::int32_t> all_owners(const DescriptorTree& tree) {
  std::vector<std::int32_t> owners;
  for (std::size_t i = 0; i < tree.leaf_count(); ++i) {
    const auto& of_leaf = tree.leaf(static_cast<std::int32_t>(i)).owners;
    owners.insert(owners.end(), of_leaf.begin(), of_leaf.end());
  }
  std::sort(owners.begin(), owners.end());
  return owners;
}

/// How many rows of `queries`, which the owner of the same number has, are in the leaves found.
std::size_t count_found(const DescriptorTree& tree, const Descriptors& queries, std::size_t most) {
  std::size_t found = 0;
  for (const auto& visit : tree.find_leaves(queries, most)) {
    const auto& owners = tree.leaf(visit.leaf).owners;
    found += static_cast<std::size_t>(std::count(owners.begin(), owners.end(), visit.query));
  }
  return found;
}

TEST_P(EachKind, every_row_is_in_one_leaf) {
  const Descriptors rows = random_descriptors(5000, 1);
  const DescriptorTree tree = grow(rows);
  std::vector<std::int32_t> expected(rows.count());
  std::iota(expected.begin(), expected.end(), 0);
  EXPECT_EQ(all_owners(tree), expected);
  for (std::size_t i = 0; i < tree.leaf_count(); ++i) {
    const auto& leaf = tree.leaf(static_cast<std::int32_t>(i));
    ASSERT_LE(leaf.owners.size(), 128U);
    ASSERT_EQ(leaf.rows.size() * 8, leaf.owners.size() * rows.stride());
    for (std::size_t r = 0; r < leaf.owners.size(); ++r) {
      const auto* row = reinterpret_cast<const std::uint8_t*>(leaf.rows.data()) + r * rows.stride();
      ASSERT_EQ(std::memcmp(row, rows.row(static_cast<std::size_t>(leaf.owners[r])), rows.stride()), 0);
    }
  }
}

TEST_P(EachKind, equal_rows_are_found_in_the_first_leaf) {
  const Descriptors rows = random_descriptors(5000, 2);
  EXPECT_EQ(count_found(grow(rows), rows, 1), rows.count());
}

TEST_P(EachKind, more_leaves_find_more_of_the_disturbed_rows_and_all_leaves_find_all) {
  const Descriptors rows = random_descriptors(3000, 3);
  const DescriptorTree tree = grow(rows);
  Descriptors disturbed = rows;
  Random random(4);
  for (std::size_t i = 0; i < rows.count(); ++i)
    for (std::size_t b = 0; b < rows.bytes(); b += 4)
      disturbed.row(i)[b] ^= static_cast<std::uint8_t>(1U << random.index(6));
  const std::size_t one = count_found(tree, disturbed, 1), two = count_found(tree, disturbed, 2);
  const std::size_t eight = count_found(tree, disturbed, 8);
  EXPECT_GT(one, rows.count() / 5);
  EXPECT_GT(two, one);
  EXPECT_GT(eight, two);
  EXPECT_EQ(count_found(tree, disturbed, tree.leaf_count()), rows.count());
  EXPECT_EQ(count_found(tree, disturbed, tree.leaf_count() + 1), rows.count());
  EXPECT_TRUE(tree.find_leaves(disturbed, 0).empty());
}

TEST_P(EachKind, measures_what_the_kernels_measure) {
  const Descriptors rows = random_descriptors(10, 5);
  const DescriptorTree tree = grow(rows);
  std::vector<std::int32_t> distances;
  tree.measure(rows, 3, tree.leaf(0), distances);
  ASSERT_EQ(distances.size(), 10U);
  for (std::size_t i = 0; i < 10; ++i) {
    int expected = 0;
    for (std::size_t b = 0; b < rows.bytes(); ++b) {
      const int x = rows.row(3)[b], y = rows.row(i)[b];
      expected += rows.norm() == Norm::l2
                      ? (x - y) * (x - y)
                      : __builtin_popcount(static_cast<unsigned>(x) ^ static_cast<unsigned>(y));
    }
    EXPECT_EQ(distances[i], expected);
  }
}

TEST_P(EachKind, the_same_calls_make_the_same_tree) {
  const Descriptors rows = random_descriptors(3000, 6);
  const DescriptorTree one = grow(rows), other = grow(rows);
  ASSERT_EQ(one.leaf_count(), other.leaf_count());
  for (std::size_t i = 0; i < one.leaf_count(); ++i)
    EXPECT_EQ(one.leaf(static_cast<std::int32_t>(i)).owners, other.leaf(static_cast<std::int32_t>(i)).owners);
}

TEST_P(EachKind, drops_what_is_not_kept) {
  const Descriptors rows = random_descriptors(2000, 7);
  DescriptorTree tree = grow(rows);
  tree.keep([](std::int32_t owner) { return owner % 3 == 0; });
  const auto owners = all_owners(tree);
  EXPECT_EQ(owners.size(), 667U);
  EXPECT_TRUE(std::all_of(owners.begin(), owners.end(), [](std::int32_t owner) { return owner % 3 == 0; }));
  EXPECT_EQ(count_found(tree, rows, 1), 667U);
}

TEST(DescriptorTree, takes_any_number_of_equal_rows) {
  const Descriptors rows(Norm::hamming, 32, 10000);
  const DescriptorTree tree = grow(rows);
  EXPECT_EQ(tree.leaf_count(), 1U);
  EXPECT_EQ(tree.leaf(0).owners.size(), 10000U);
}

TEST(DescriptorTree, cuts_into_as_many_as_there_are_different_ones) {
  Descriptors rows(Norm::hamming, 32, 2000);
  for (std::size_t i = 0; i < rows.count(); ++i) rows.row(i)[0] = static_cast<std::uint8_t>(i % 5);
  const DescriptorTree tree = grow(rows);
  EXPECT_EQ(tree.leaf_count(), 5U);
  EXPECT_EQ(all_owners(tree).size(), 2000U);
}

TEST(DescriptorTree, refuses_numbers_out_of_range) {
  const Descriptors kind(Norm::hamming, 32, 0);
  EXPECT_THROW(DescriptorTree(kind, {.branching = 1}), PreconditionError);
  EXPECT_THROW(DescriptorTree(kind, {.branching = 8, .leaf_capacity = 7}), PreconditionError);
  EXPECT_THROW(DescriptorTree(Descriptors(), {}), PreconditionError);
}

}  // namespace
}  // namespace cairn
