// SPDX-License-Identifier: Apache-2.0
#include "cairn/evaluate/evaluation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "cairn/core/error.h"
#include "cairn/testing/geometry/reference_drive.h"

namespace cairn {
namespace {

using testkit::estimated_drive;
using testkit::true_drive;

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

Trajectory trajectory_of(Rigid3 (*pose)(int), std::int64_t offset_ns = 0, int count = 12) {
  Trajectory trajectory;
  for (int i = 0; i < count; ++i)
    trajectory.push_back({i * 100'000'000LL + offset_ns, WorldFromCamera(pose(i))});
  return trajectory;
}

EvaluationOptions options_with(AlignmentMode alignment, const std::vector<RpeOptions>& rpe) {
  EvaluationOptions options;
  options.alignment = alignment;
  options.rpe = rpe;
  return options;
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

/// Computed by evaluation_reference.py; evo 1.36.5 (evaluation_evo.py), which has no interval in seconds,
/// says the same to 1e-12.
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
    {AlignmentMode::se3,
     {0.3, RpeUnit::seconds, false},
     1,
     kRigidAteM,
     kAteDeg,
     {8, 0.221104617322569, 0.215889636177152, 0.206361787279243, 0.047738001557003, 0.154779598287196,
      0.291400008930955},
     {8, 1.16490437052339, 1.12862589636544, 1.07015715771977, 0.288454118566188, 0.790521434457899,
      1.51503152079033}},
};

constexpr Row kDriveRigidAteM{400,
                              4.90731811023694,
                              4.61322034289285,
                              3.9294943273007,
                              1.67331082079185,
                              3.11629068360333,
                              10.2416684362188};
constexpr Row kDriveScaledAteM{400,
                               3.63679434731028,
                               3.16646074629745,
                               3.27730128467216,
                               1.78879833038424,
                               0.061572288360687,
                               8.20079190989122};
constexpr Row kDriveAteDeg{400,
                           1.3672170759894,
                           1.19172340332911,
                           1.18327120722209,
                           0.670132720313447,
                           0.0143107900498615,
                           2.36986165100312};

TEST(Evaluation, EqualsTheReferenceImplementation) {
  for (const Case& expected : kCases) {
    SCOPED_TRACE(&expected - kCases);
    const TrajectoryEvaluation found =
        evaluate_trajectory(trajectory_of(estimated_pose, 5'000'000), trajectory_of(reference_pose),
                            options_with(expected.alignment, {expected.rpe}));
    ASSERT_EQ(found.status, EvaluationStatus::ok);
    EXPECT_NEAR(found.absolute.reference_from_estimate.scale, expected.scale, 1e-12);
    expect_near(found.absolute.ate_m, expected.ate_m);
    expect_near(found.absolute.ate_deg, expected.ate_deg);
    expect_near(found.relative.at(0).rpe_m, expected.rpe_m);
    expect_near(found.relative.at(0).rpe_deg, expected.rpe_deg);
  }
}

/// The figures are evo's, printed by evaluation_evo.py.
TEST(Evaluation, EqualsEvoOnALongDrive) {
  const Trajectory estimate = trajectory_of(estimated_drive, 0, 400),
                   truth = trajectory_of(true_drive, 0, 400);
  const TrajectoryEvaluation rigid =
      evaluate_trajectory(estimate, truth, options_with(AlignmentMode::se3, {{10, RpeUnit::metres, false}}));
  expect_near(rigid.se3.ate_m, kDriveRigidAteM);
  expect_near(rigid.se3.ate_deg, kDriveAteDeg);
  expect_near(rigid.sim3.ate_m, kDriveScaledAteM);
  expect_near(rigid.sim3.ate_deg, kDriveAteDeg);
  EXPECT_NEAR(rigid.sim3.reference_from_estimate.scale, 0.990555236543478, 1e-12);
  expect_near(rigid.relative.at(0).rpe_m, {109, 0.294755786028326, 0.271204962125906, 0.266116210025199,
                                           0.115450603789943, 0.0646700561626731, 0.562840411228598});
  expect_near(rigid.relative.at(0).rpe_deg, {109, 0.136207567766182, 0.124965349178952, 0.120618689977154,
                                             0.0541863730227602, 0.00728044355893572, 0.251285984856186});
  const TrajectoryEvaluation scaled =
      evaluate_trajectory(estimate, truth, options_with(AlignmentMode::sim3, {{10, RpeUnit::frames, true}}));
  expect_near(scaled.absolute.ate_m, kDriveScaledAteM);
  expect_near(scaled.relative.at(0).rpe_m, {390, 0.722010636863503, 0.636916639416301, 0.631919397300796,
                                            0.340053751896206, 0.0362652808989243, 1.32113442154944});
  expect_near(scaled.relative.at(0).rpe_deg, {390, 0.141327674755119, 0.135761801969527, 0.144736190473125,
                                              0.0392714244416415, 0.0394896432358707, 0.198233799017526});
}

TEST(Evaluation, SaysThatNothingMatches) {
  const TrajectoryEvaluation found =
      evaluate_trajectory(trajectory_of(estimated_pose, 30'000'000), trajectory_of(reference_pose));
  EXPECT_EQ(found.status, EvaluationStatus::no_pairs);
  EXPECT_FALSE(found.absolute.ate_m);
}

TEST(Evaluation, SaysWhyItCannotAlign) {
  Trajectory two = trajectory_of(reference_pose);
  two.resize(2);
  const TrajectoryEvaluation few = evaluate_trajectory(two, trajectory_of(reference_pose));
  EXPECT_EQ(few.status, EvaluationStatus::not_alignable);
  EXPECT_EQ(few.absolute.status, AlignmentStatus::too_few_points);
  const TrajectoryEvaluation plain = evaluate_trajectory(
      two, trajectory_of(reference_pose), options_with(AlignmentMode::none, {{1, RpeUnit::frames, false}}));
  EXPECT_EQ(plain.status, EvaluationStatus::ok);
  EXPECT_EQ(plain.absolute.ate_m->max, 0);
  EXPECT_EQ(plain.se3.status, AlignmentStatus::too_few_points);
  EXPECT_FALSE(plain.sim3.ate_m);
}

TEST(Evaluation, IsZeroForIdenticalTrajectories) {
  const Trajectory truth = trajectory_of(true_drive, 0, 400);
  const TrajectoryEvaluation found = evaluate_trajectory(truth, truth);
  ASSERT_EQ(found.status, EvaluationStatus::ok);
  EXPECT_LT(found.absolute.ate_m->max, 1e-10);
  EXPECT_LT(found.drift->all.translation_percent, 1e-10);
  EXPECT_NEAR(found.sim3.reference_from_estimate.scale, 1, 1e-12);
  EXPECT_LT(found.absolute.turn_uncertainty, 1e-9);
}

TEST(Evaluation, GoesWithoutRpeWhereTheDeltaIsTooLong) {
  const TrajectoryEvaluation found =
      evaluate_trajectory(trajectory_of(estimated_pose), trajectory_of(reference_pose),
                          options_with(AlignmentMode::se3, {{50, RpeUnit::metres, false}}));
  EXPECT_EQ(found.status, EvaluationStatus::ok);
  EXPECT_TRUE(found.absolute.ate_m);
  EXPECT_FALSE(found.relative.at(0).rpe_m);
  EXPECT_FALSE(found.drift);
}

TEST(Evaluation, RefusesPosesThatAreNoNumbers) {
  Trajectory broken = trajectory_of(estimated_pose);
  broken[3].world_from_camera.translation.y() = std::nan("");
  EXPECT_THROW((void)evaluate_trajectory(broken, trajectory_of(reference_pose)), PreconditionError);
}

/// How long it takes is measured in benchmarks/evaluation.cpp.
TEST(Evaluation, TakesTwentyThousandPoses) {
  const Trajectory estimate = trajectory_of(estimated_drive, 1'000'000, 20'000),
                   truth = trajectory_of(true_drive, 0, 20'000);
  const TrajectoryEvaluation found = evaluate_trajectory(estimate, truth);
  EXPECT_EQ(found.pairs.size(), estimate.size());
  EXPECT_TRUE(found.drift);
  EXPECT_EQ(found.absolute.ate_m->count, estimate.size());
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
    estimate.push_back({truth[i].stamp_ns + 1'000'000, WorldFromCamera(moved * truth[i].world_from_camera)});
  const TrajectoryEvaluation found =
      evaluate_trajectory(estimate, truth, options_with(AlignmentMode::sim3, {{1, RpeUnit::frames, false}}));
  ASSERT_EQ(found.status, EvaluationStatus::ok);
  EXPECT_EQ(found.pairs.size(), estimate.size());
  EXPECT_NEAR(found.absolute.reference_from_estimate.scale, 2.0, 1e-12);
  EXPECT_LT(found.absolute.ate_m->max, 1e-12);
  EXPECT_LT(found.relative.at(0).rpe_deg->max, 1e-5);
}

}  // namespace
}  // namespace cairn
