// SPDX-License-Identifier: Apache-2.0
#include "cairn/evaluate/evaluation.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "cairn/core/error.h"

namespace cairn {
namespace {

/// The trajectories of evaluation_reference.py, 0.1 s apart.
Rigid3 reference_pose(int i) {
  return {rotation_exp({0.1 * std::sin(i), 0.2 * std::cos(0.5 * i), 0.3 * i + 0.1}),
          {std::cos(0.3 * i), 1.5 * std::sin(0.3 * i), 0.1 * i + 0.05 * std::sin(i)}};
}

Rigid3 estimated_pose(int i) {
  const Rigid3 truth = reference_pose(i);
  const Eigen::Quaterniond turn = rotation_exp({0, 0, 0.5});
  const Eigen::Vector3d noise(0.02 * std::sin(7 * i), 0.02 * std::cos(5 * i), 0.02 * std::sin(3 * i + 1));
  const Eigen::Quaterniond wobble =
      rotation_exp({0.01 * std::cos(3 * i), 0.01 * std::sin(2 * i), 0.01 * std::cos(i)});
  return {turn * truth.rotation * wobble,
          0.8 * (turn * (truth.translation + noise)) + Eigen::Vector3d(1, 2, 3)};
}

Trajectory trajectory_of(Rigid3 (*pose)(int), std::int64_t offset_ns = 0) {
  Trajectory trajectory;
  for (int i = 0; i < 12; ++i) trajectory.push_back({i * 100'000'000LL + offset_ns, pose(i)});
  return trajectory;
}

/// count, rmse, mean, median, std, min, max
using Row = std::array<double, 7>;

void expect_near(const std::optional<ErrorStatistics>& found, const Row& expected) {
  ASSERT_TRUE(found);
  const Row values{static_cast<double>(found->count),
                   found->rmse,
                   found->mean,
                   found->median,
                   found->std,
                   found->min,
                   found->max};
  for (std::size_t i = 0; i < values.size(); ++i) EXPECT_NEAR(values[i], expected[i], 1e-11) << i;
}

struct Case {
  AlignmentMode alignment;
  RpeOptions rpe;
  double scale;
  Row ate_m, ate_deg, rpe_m, rpe_deg;
};

constexpr Row kRigidAteM{12,
                         0.201061548593556,
                         0.191328943555093,
                         0.165890219135287,
                         0.0617979100045527,
                         0.127093441560495,
                         0.304538372433077};
constexpr Row kAteDeg{12,
                      0.908535511730261,
                      0.867338582028393,
                      0.88568458490319,
                      0.270482088501152,
                      0.447141988097516,
                      1.27142523137558};
constexpr Row kScaledAteM{12,
                          0.0210199366338252,
                          0.0201859886740856,
                          0.0193495422781312,
                          0.00586204719698801,
                          0.0115470824744854,
                          0.0298404076485797};
constexpr Row kFrameRpeM{11,
                         0.084094083076811,
                         0.0812674420206818,
                         0.0823028387094154,
                         0.0216198444939995,
                         0.050604876462578,
                         0.116792229126784};
constexpr Row kFrameRpeDeg{11,
                           1.11211358907527,
                           1.08044494467714,
                           1.02261019391161,
                           0.263505894673146,
                           0.616102068356002,
                           1.54290045447449};

/// Computed by evaluation_reference.py.
const Case kCases[] = {
    {AlignmentMode::none,
     {1, RpeUnit::frames, false},
     1,
     {12, 3.47982588830561, 3.47403934112144, 3.43022169233152, 0.20059628426864, 3.24375905822603,
      3.91299699576055},
     {12, 28.6310736160024, 28.6281409111558, 28.6267431551949, 0.409785768360731, 28.0858528244781,
      29.2687532877467},
     kFrameRpeM,
     kFrameRpeDeg},
    {AlignmentMode::se3, {1, RpeUnit::frames, false}, 1, kRigidAteM, kAteDeg, kFrameRpeM, kFrameRpeDeg},
    {AlignmentMode::se3,
     {3, RpeUnit::frames, false},
     1,
     kRigidAteM,
     kAteDeg,
     {3, 0.234608590576247, 0.227785503229629, 0.237176902470736, 0.0561689886912505, 0.154779598287196,
      0.291400008930955},
     {3, 1.37632718335657, 1.36743251671407, 1.43599924071168, 0.1562204464187, 1.1512667886402,
      1.51503152079033}},
    {AlignmentMode::se3,
     {3, RpeUnit::frames, true},
     1,
     kRigidAteM,
     kAteDeg,
     {9, 0.227434487698034, 0.222217115501803, 0.222077478723183, 0.048435521805031, 0.154779598287196,
      0.291400008930955},
     {9, 1.10286018083377, 1.03668345564461, 0.989047526799335, 0.376281797674881, 0.301143929878004,
      1.51503152079033}},
    {AlignmentMode::sim3,
     {1, RpeUnit::metres, false},
     1.25004726656923,
     kScaledAteM,
     kAteDeg,
     {2, 0.03306305431638, 0.0307193730898838, 0.0307193730898838, 0.0122264335638982, 0.0184929395259856,
      0.042945806653782},
     {2, 1.34549911326879, 1.33314915471527, 1.33314915471527, 0.181882366075065, 1.1512667886402,
      1.51503152079033}},
    {AlignmentMode::sim3,
     {1, RpeUnit::metres, true},
     1.25004726656923,
     kScaledAteM,
     kAteDeg,
     {5, 0.042092038626489, 0.0408075296950882, 0.042945806653782, 0.0103191683733882, 0.0273891533607914,
      0.0545292576109465},
     {5, 1.12212465864489, 1.06484337926931, 0.854318566547381, 0.353938309829886, 0.692609831595295,
      1.51503152079033}},
};

TEST(Evaluation, EqualsTheReferenceImplementation) {
  for (const Case& expected : kCases) {
    SCOPED_TRACE(&expected - kCases);
    const TrajectoryEvaluation found =
        evaluate_trajectory(trajectory_of(estimated_pose, 5'000'000), trajectory_of(reference_pose),
                            {expected.alignment, 0.02, expected.rpe});
    ASSERT_EQ(found.status, EvaluationStatus::ok);
    EXPECT_NEAR(found.reference_from_estimate.scale, expected.scale, 1e-12);
    expect_near(found.ate_m, expected.ate_m);
    expect_near(found.ate_deg, expected.ate_deg);
    expect_near(found.rpe_m, expected.rpe_m);
    expect_near(found.rpe_deg, expected.rpe_deg);
  }
}

TEST(Evaluation, SaysThatNothingMatches) {
  const TrajectoryEvaluation found =
      evaluate_trajectory(trajectory_of(estimated_pose, 30'000'000), trajectory_of(reference_pose));
  EXPECT_EQ(found.status, EvaluationStatus::no_pairs);
  EXPECT_FALSE(found.ate_m);
}

TEST(Evaluation, SaysWhyItCannotAlign) {
  Trajectory two = trajectory_of(reference_pose);
  two.resize(2);
  const TrajectoryEvaluation few = evaluate_trajectory(two, trajectory_of(reference_pose));
  EXPECT_EQ(few.status, EvaluationStatus::not_alignable);
  EXPECT_EQ(few.alignment_status, AlignmentStatus::too_few_points);
  const TrajectoryEvaluation plain =
      evaluate_trajectory(two, trajectory_of(reference_pose), {AlignmentMode::none, 0.02, {}});
  EXPECT_EQ(plain.status, EvaluationStatus::ok);
  EXPECT_EQ(plain.ate_m->max, 0);
}

TEST(Evaluation, GoesWithoutRpeWhereTheDeltaIsTooLong) {
  const TrajectoryEvaluation found =
      evaluate_trajectory(trajectory_of(estimated_pose), trajectory_of(reference_pose),
                          {AlignmentMode::se3, 0.02, {50, RpeUnit::metres, false}});
  EXPECT_EQ(found.status, EvaluationStatus::ok);
  EXPECT_TRUE(found.ate_m);
  EXPECT_FALSE(found.rpe_m);
}

TEST(Evaluation, MatchesMotionCaptureWithItself) {
  const std::filesystem::path path =
      std::filesystem::path(CAIRN_DATA_DIR) / "rgbd/fr1_desk_excerpt/groundtruth.txt";
  if (!std::filesystem::exists(path)) {
    ASSERT_EQ(std::getenv("CAIRN_REQUIRE_DATA"), nullptr) << path << " is missing";
    GTEST_SKIP() << "needs " << path;
  }
  const Trajectory truth = read_tum_trajectory(path);
  const Similarity3 moved{0.5, rotation_exp({1, 2, 3}), {10, 20, 30}};
  Trajectory estimate;
  for (std::size_t i = 0; i < truth.size(); i += 3)
    estimate.push_back({truth[i].stamp_ns + 1'000'000, moved * truth[i].world_from_camera});
  const TrajectoryEvaluation found = evaluate_trajectory(estimate, truth, {AlignmentMode::sim3, 0.02, {}});
  ASSERT_EQ(found.status, EvaluationStatus::ok);
  EXPECT_EQ(found.pairs.size(), estimate.size());
  EXPECT_NEAR(found.reference_from_estimate.scale, 2.0, 1e-12);
  EXPECT_LT(found.ate_m->max, 1e-12);
  EXPECT_LT(found.rpe_deg->max, 1e-5);
}

}  // namespace
}  // namespace cairn
