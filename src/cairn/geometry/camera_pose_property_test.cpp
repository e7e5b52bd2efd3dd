// SPDX-License-Identifier: Apache-2.0
// What holds for estimate_pose whatever its options: over many simulated problems the errors are as large as
// the covariance says, and the variance factor is 1.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "cairn/geometry/inlier_limits.h"
#include "cairn/testing/geometry/pose_scene.h"

namespace cairn {
namespace {

using testkit::error_of;
using testkit::kPoseRig;
using testkit::make_pose_scene;
using testkit::nudged;
using testkit::PoseScene;
using testkit::PoseSceneOptions;

struct OptionSet {
  const char* name;
  PoseOptions options;
};

std::ostream& operator<<(std::ostream& out, const OptionSet& set) {
  return out << set.name;
}

PoseOptions options_of(PoseSelection selection, PoseMethod method, RobustKernel kernel,
                       double scale = kInlierScale2) {
  PoseOptions options;
  options.selection = selection, options.method = method;
  options.kernel = kernel, options.kernel_scale = scale;
  return options;
}

constexpr auto kAll = PoseSelection::all, kInliers = PoseSelection::inliers,
               kFromAll = PoseSelection::inliers_from_all;
constexpr auto kGauss = PoseMethod::gauss_newton, kMarquardt = PoseMethod::levenberg_marquardt;

const OptionSet kOptionSets[] = {
    {"all_gauss_newton", options_of(kAll, kGauss, RobustKernel::none)},
    {"all", options_of(kAll, kMarquardt, RobustKernel::none)},
    {"all_huber", options_of(kAll, kMarquardt, RobustKernel::huber)},
    {"all_narrow_huber", options_of(kAll, kMarquardt, RobustKernel::huber, 1.345)},
    {"all_cauchy", options_of(kAll, kMarquardt, RobustKernel::cauchy, 2.385)},
    {"all_geman_mcclure", options_of(kAll, kMarquardt, RobustKernel::geman_mcclure, 4)},
    {"inliers", options_of(kInliers, kMarquardt, RobustKernel::none)},
    {"inliers_huber", options_of(kInliers, kMarquardt, RobustKernel::huber)},
    {"inliers_cauchy", options_of(kInliers, kMarquardt, RobustKernel::cauchy, 2.385)},
    {"from_all", options_of(kFromAll, kMarquardt, RobustKernel::none)},
    {"from_all_huber", options_of(kFromAll, kMarquardt, RobustKernel::huber)},
    {"from_all_huber_gauss_newton", options_of(kFromAll, kGauss, RobustKernel::huber)},
};

class CameraPoseProperty : public testing::TestWithParam<std::tuple<OptionSet, bool, bool>> {
 protected:
  [[nodiscard]] PoseSceneOptions scene_options() const {
    return {.count = 120, .stereo = std::get<1>(GetParam()), .uncertain = std::get<2>(GetParam())};
  }
  [[nodiscard]] const PoseOptions& options() const { return std::get<0>(GetParam()).options; }
};

/// The pose by a third of the points: off by more than the estimate, and not towards the truth.
CameraFromWorld rough_pose(const PoseScene& scene) {
  const std::size_t third = scene.points.size() / 3;
  PoseOptions options;
  options.selection = PoseSelection::all;
  return estimate_pose(kPoseRig, {std::span(scene.points).first(third), std::span(scene.seen).first(third)},
                       nudged(scene.camera_from_world, 0.02), options)
      .camera_from_world;
}

struct Honesty {
  double nees = 0;  ///< normalised estimation error squared over its degrees of freedom
  double variance_factor = 0;
};

/// Returns how honest an estimate is, both figures times `weight`.
Honesty honesty_of(const PoseEstimate& found, const PoseScene& scene, double weight) {
  const Vector6d error = error_of(found, scene);
  return {weight * error.dot(found.covariance.ldlt().solve(error)) / 6, weight * found.variance_factor};
}

class SlowCameraPoseHonesty : public CameraPoseProperty {};

TEST_P(SlowCameraPoseHonesty, covariance_and_variance_factor_are_honest) {
  // Least squares of all, of the same problems, has the expectation 1 for both figures, as no observation is
  // an outlier. What chance adds to it is taken away from the estimate, too: the mean of NEES / 6 then has a
  // standard deviation of 0.33 over the root of the number of problems, not of 0.58.
  const int problems = scene_options().uncertain ? 2000 : 4000;
  const PoseOptions least_squares = options_of(kAll, kGauss, RobustKernel::none);
  Honesty mean{1, 1};
  for (int i = 0; i < problems; ++i) {
    const PoseScene scene = make_pose_scene(1000 + static_cast<std::uint64_t>(i), scene_options());
    const CameraFromWorld start = rough_pose(scene);
    const PoseEstimate found = estimate_pose(kPoseRig, scene.correspondences(), start, options());
    ASSERT_TRUE(found.found()) << to_string(found.status);
    const Honesty one = honesty_of(found, scene, 1.0 / problems);
    const PoseEstimate all = estimate_pose(kPoseRig, scene.correspondences(), start, least_squares);
    const Honesty chance = honesty_of(all, scene, 1.0 / problems);
    mean.nees += one.nees - chance.nees;
    mean.variance_factor += one.variance_factor - chance.variance_factor;
  }
  EXPECT_NEAR(mean.variance_factor, 1, 0.03);
  EXPECT_NEAR(mean.nees, 1, 0.05);
}

TEST_P(CameraPoseProperty, the_same_problem_gives_the_same_bytes_and_no_covariance_is_lopsided) {
  const PoseScene scene = make_pose_scene(7, scene_options());
  const CameraFromWorld start = nudged(scene.camera_from_world, 0.02);
  const PoseEstimate one = estimate_pose(kPoseRig, scene.correspondences(), start, options());
  const PoseEstimate two = estimate_pose(kPoseRig, scene.correspondences(), start, options());
  EXPECT_EQ(one.camera_from_world.matrix3(), two.camera_from_world.matrix3());
  EXPECT_EQ(one.covariance, two.covariance);
  EXPECT_EQ(one.covariance, one.covariance.transpose());
  EXPECT_GT(one.covariance.diagonal().minCoeff(), 0);
}

TEST_P(CameraPoseProperty, failures_leave_no_covariance) {
  PoseScene scene = make_pose_scene(8, scene_options());
  const CameraFromWorld backwards(Rigid3{rotation_exp({0, 3.1, 0}), {0, 0, 0}} * scene.camera_from_world);
  const PoseEstimate behind = estimate_pose(kPoseRig, scene.correspondences(), backwards, options());
  EXPECT_FALSE(behind.found());
  for (auto& point : scene.points) point = scene.points[1];
  for (auto& seen : scene.seen) seen = scene.seen[1];
  const PoseEstimate one_place =
      estimate_pose(kPoseRig, scene.correspondences(), scene.camera_from_world, options());
  EXPECT_EQ(one_place.status, PoseStatus::undetermined);
  for (const PoseEstimate& failed : {behind, one_place}) {
    EXPECT_TRUE(failed.covariance.isZero());
    EXPECT_TRUE(failed.camera_from_world.translation.allFinite());
  }
}

std::string name_of(const testing::TestParamInfo<CameraPoseProperty::ParamType>& info) {
  const auto& [set, stereo, uncertain] = info.param;
  return std::string(set.name) + (stereo ? "_stereo" : "") + (uncertain ? "_uncertain_points" : "");
}

const auto kEverySet = testing::Combine(testing::ValuesIn(kOptionSets), testing::Bool(), testing::Bool());
INSTANTIATE_TEST_SUITE_P(OptionSets, CameraPoseProperty, kEverySet, name_of);
INSTANTIATE_TEST_SUITE_P(OptionSets, SlowCameraPoseHonesty, kEverySet, name_of);

}  // namespace
}  // namespace cairn
