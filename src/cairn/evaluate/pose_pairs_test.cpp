// SPDX-License-Identifier: Apache-2.0
#include "cairn/evaluate/pose_pairs.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <initializer_list>

#include "cairn/core/error.h"
#include "cairn/core/file.h"
#include "cairn/testing/core/temporary_folder.h"

namespace cairn {
namespace {

/// Poses at these milliseconds; x is the stamp in seconds, so that a pair shows where it came from.
Trajectory at_ms(std::initializer_list<int> stamps_ms) {
  Trajectory trajectory;
  for (const int stamp : stamps_ms)
    trajectory.push_back(
        {stamp * 1'000'000LL, WorldFromCamera({Eigen::Quaterniond::Identity(), {0.001 * stamp, 0, 0}})});
  return trajectory;
}

std::vector<std::pair<int, int>> pairs_ms(const Trajectory& estimate, const Trajectory& reference,
                                          double max_gap_s) {
  std::vector<std::pair<int, int>> result;
  for (const auto& pair : pair_poses(estimate, reference, max_gap_s)) {
    EXPECT_EQ(pair.stamp_ns, std::llround(1e9 * pair.estimate.translation.x()));
    result.emplace_back(std::lround(1e3 * pair.estimate.translation.x()),
                        std::lround(1e3 * pair.reference.translation.x()));
  }
  return result;
}

using Pairs = std::vector<std::pair<int, int>>;

TEST(PosePairs, TakeTheNearestFirstAndEachOnce) {
  // 104 is nearer to 105 than 100 is; 100 is left with 90, which is within the limit
  EXPECT_EQ(pairs_ms(at_ms({100, 104, 200}), at_ms({90, 105, 300}), 0.02), (Pairs{{100, 90}, {104, 105}}));
}

TEST(PosePairs, LimitTheGapInclusively) {
  EXPECT_EQ(pairs_ms(at_ms({100}), at_ms({120}), 0.02), (Pairs{{100, 120}}));
  EXPECT_EQ(pairs_ms(at_ms({100}), at_ms({121}), 0.02), Pairs{});
  EXPECT_EQ(pairs_ms(at_ms({100, 200}), at_ms({200}), 0.0), (Pairs{{200, 200}}));
}

TEST(PosePairs, OfNothingAreNothing) {
  EXPECT_TRUE(pair_poses({}, at_ms({1}), 1.0).empty());
  EXPECT_THROW((void)pair_poses({}, {}, -1.0), PreconditionError);
}

class PosePairsFile : public ::testing::Test {
 protected:
  void write(std::string_view text) const { folder_.write("pairs.txt", text); }

  const testkit::TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "pairs.txt";
};

TEST_F(PosePairsFile, IsReadInItsOrder) {
  write("2 1 2 3 0 0 0 1  2.5 4 5 6 0 0 1 0\n# comment\n1 0 0 0 0 0 0 1 7 0 0 0 1 0 0 0\n");
  const std::vector<PosePair> pairs = read_pose_pairs(path_);
  ASSERT_EQ(pairs.size(), 2U);
  EXPECT_EQ(pairs[0].stamp_ns, 2'000'000'000);
  EXPECT_EQ(pairs[0].estimate.translation, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(pairs[0].reference.translation, Eigen::Vector3d(4, 5, 6));
  EXPECT_EQ(pairs[0].reference.rotation.z(), 1);
  EXPECT_EQ(pairs[1].stamp_ns, 1'000'000'000);
}

TEST_F(PosePairsFile, IsRefusedWithTheLine) {
  for (const std::string_view text :
       {"# nothing\n", "1 0 0 0 0 0 0 1\n", "1 0 0 0 0 0 0 1 1 0 0 nan 0 0 0 1\n",
        "1 0 0 0 0 0 0 1 1 0 0 1e200 0 0 0 1\n", "1 0 0 0 0 0 0 1 1 0 0 0 0 0 0 9\n"}) {
    write(text);
    EXPECT_THROW((void)read_pose_pairs(path_), InputError) << text;
  }
}

/// The transform that the course gives for its file (to six digits), ground truth from estimate.
TEST(PosePairsData, AlignTheCoursesTrajectories) {
  const std::filesystem::path file = std::filesystem::path(CAIRN_DATA_DIR) / "course/align/compare.txt";
  if (!std::filesystem::exists(file)) {
    ASSERT_EQ(std::getenv("CAIRN_REQUIRE_DATA"), nullptr) << file << " is missing";
    GTEST_SKIP() << "needs " << file;
  }
  const std::vector<PosePair> pairs = read_pose_pairs(file);
  ASSERT_EQ(pairs.size(), 612U);
  const Alignment found = align_pairs(pairs, false);
  Eigen::Matrix3d rotation;
  rotation << 0.923062, 0.133592, -0.360707, 0.369046, -0.571969, 0.732568, -0.108448, -0.809323, -0.577265;
  EXPECT_LT((found.target_from_source.rotation.toRotationMatrix() - rotation).cwiseAbs().maxCoeff(), 1e-6);
  const Eigen::Vector3d translation(1.5394, 0.932636, 1.44618);
  EXPECT_LT((found.target_from_source.translation - translation).cwiseAbs().maxCoeff(), 1e-5);
  // evo's umeyama_alignment leaves these
  EXPECT_NEAR(rms_distance(pairs), 2.5627343429561895, 1e-9);
  EXPECT_NEAR(found.rmse, 0.023090455331168956, 1e-9);
  EXPECT_NEAR(rms_distance(aligned_pairs(found.target_from_source, pairs)), found.rmse, 1e-12);
  const Alignment scaled = align_pairs(pairs, true);
  EXPECT_NEAR(scaled.target_from_source.scale, 0.9952444114285373, 1e-9);
  EXPECT_NEAR(scaled.rmse, 0.022619955121658604, 1e-9);
}

}  // namespace
}  // namespace cairn
