// SPDX-License-Identifier: Apache-2.0
#include "cairn/optimize/pose_fit.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "cairn/core/error.h"
#include "cairn/core/random.h"
#include "cairn/core/text.h"

namespace cairn {
namespace {

constexpr Rig kRig{525, 525, 319.5, 239.5, 0.075};

struct Scene {
  CameraFromWorld camera_from_world;
  std::vector<Eigen::Vector3d> points;
  std::vector<Observation> seen;
};

/// Points in view at 1 to 5 m, a pixel of noise times `noise`; the first `outliers` of them 30 px and more
/// aside.
Scene make_scene(std::uint64_t seed, int count, double noise = 1, int outliers = 0) {
  Random random(seed);
  Scene scene;
  scene.camera_from_world =
      CameraFromWorld({rotation_exp({random.normal(), random.normal(), random.normal()}),
                       {random.normal(), random.normal(), random.normal()}});
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d in_camera =
        kRig.point_at(random.uniform(0, 639), random.uniform(0, 479), random.uniform(1, 5));
    const Eigen::Vector3d exact = kRig.project(in_camera);
    Observation seen{exact.x() + noise * random.normal(), exact.y() + noise * random.normal()};
    if (i < outliers) seen.u += random.uniform(30, 60);
    scene.points.push_back(scene.camera_from_world.inverse() * in_camera);
    scene.seen.push_back(seen);
  }
  return scene;
}

CameraFromWorld nudged(const CameraFromWorld& pose, double size = 1) {
  Vector6d xi;
  xi << 0.02, -0.03, 0.01, 0.03, 0.02, -0.02;
  return perturb_left(size * xi, pose);
}

PoseFit fit(const Scene& scene, const PoseFitOptions& options = {}) {
  return fit_pose(kRig, scene.points, scene.seen, nudged(scene.camera_from_world), options);
}

double error_of(const PoseFit& fit, const Scene& scene) {
  return left_perturbation(scene.camera_from_world, fit.camera_from_world).norm();
}

TEST(PoseFit, both_methods_reach_the_truth_without_noise) {
  for (const auto method : {PoseFitMethod::gauss_newton, PoseFitMethod::levenberg_marquardt}) {
    const Scene scene = make_scene(1, 30, 0);
    const PoseFit result = fit(scene, {.method = method});
    ASSERT_EQ(result.status, PoseFitStatus::ok);
    EXPECT_LT(error_of(result, scene), 1e-7);
    EXPECT_LT(result.cost, 1e-12);
    EXPECT_LE(result.iterations(), 8);
    for (std::size_t i = 1; i < result.trace.size(); ++i)
      EXPECT_LE(result.trace[i].cost, result.trace[i - 1].cost + 1e-12);
  }
}

/// 76 points of two images, from the identity: the known result of plain Gauss-Newton.
TEST(PoseFitData, reaches_the_known_minimum_from_the_identity) {
  const std::filesystem::path folder = std::filesystem::path(CAIRN_DATA_DIR) / "course/pnp";
  if (!std::filesystem::exists(folder)) {
    ASSERT_EQ(std::getenv("CAIRN_REQUIRE_DATA"), nullptr) << folder << " is not there";
    GTEST_SKIP() << folder << " is not there";
  }
  const TextFile points(folder / "p3d.txt"), pixels(folder / "p2d.txt");
  std::vector<Eigen::Vector3d> in_world;
  std::vector<Observation> seen;
  for (const TextLine& line : points.lines())
    in_world.emplace_back(points.number(line, 0, "x"), points.number(line, 1, "y"),
                          points.number(line, 2, "z"));
  for (const TextLine& line : pixels.lines())
    seen.push_back({pixels.number(line, 0, "u"), pixels.number(line, 1, "v")});
  ASSERT_EQ(seen.size(), 76U);
  const PoseFit result = fit_pose({520.9, 521.0, 325.1, 249.7, 1.0}, in_world, seen, {},
                                  {.method = PoseFitMethod::gauss_newton});
  ASSERT_EQ(result.status, PoseFitStatus::ok);
  EXPECT_NEAR(result.cost, 150.6753269, 5e-8);
  EXPECT_GE(result.iterations(), 4);
  EXPECT_LE(result.iterations(), 5);
  Eigen::Matrix<double, 3, 4> known, found;
  known << 0.997866, -0.051673, 0.039913, -0.127226, 0.050596, 0.998340, 0.027527, -0.007507, -0.041269,
      -0.025449, 0.998824, 0.061386;
  found << result.camera_from_world.matrix3(), result.camera_from_world.translation;
  EXPECT_LT((found - known).cwiseAbs().maxCoeff(), 1e-5);
}

/// Normalised estimation error squared over many problems: 6 on average where the covariance is honest.
TEST(PoseFit, reports_an_honest_covariance) {
  constexpr int kProblems = 400;
  double nees = 0, variance_factor = 0;
  for (int i = 0; i < kProblems; ++i) {
    const Scene scene = make_scene(100 + static_cast<std::uint64_t>(i), 60);
    const PoseFit result = fit(scene);
    ASSERT_EQ(result.status, PoseFitStatus::ok);
    const Vector6d error = left_perturbation(result.camera_from_world, scene.camera_from_world);
    nees += error.dot(result.covariance.inverse() * error) / kProblems;
    variance_factor += result.variance_factor / kProblems;
  }
  EXPECT_NEAR(nees, 6, 0.7);  // four standard deviations of the mean, sqrt(12 / 400)
  EXPECT_NEAR(variance_factor, 1, 0.03);
}

TEST(PoseFit, kernels_withstand_outliers) {
  const Scene scene = make_scene(2, 100, 0.5, 15);
  const double plain = error_of(fit(scene), scene);
  for (const auto kernel : {RobustKernel::huber, RobustKernel::cauchy, RobustKernel::geman_mcclure}) {
    PoseFitOptions options;
    options.kernel = kernel;
    if (kernel == RobustKernel::geman_mcclure) options.kernel_scale = 10;  // else 20 px of start are outliers
    const PoseFit result = fit(scene, options);
    ASSERT_EQ(result.status, PoseFitStatus::ok) << static_cast<int>(kernel);
    EXPECT_LT(error_of(result, scene), 0.3 * plain) << static_cast<int>(kernel);
  }
}

TEST(PoseFit, levenberg_marquardt_comes_from_where_gauss_newton_fails) {
  int damped_alone = 0;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const Scene scene = make_scene(seed, 30, 0);
    const auto solves = [&](PoseFitMethod method) {
      const PoseFit result = fit_pose(kRig, scene.points, scene.seen, nudged(scene.camera_from_world, 20),
                                      {.method = method, .max_iterations = 100});
      return result.status == PoseFitStatus::ok && error_of(result, scene) < 1e-5;
    };
    const bool plain = solves(PoseFitMethod::gauss_newton),
               damped = solves(PoseFitMethod::levenberg_marquardt);
    damped_alone += damped && !plain ? 1 : 0;
  }
  EXPECT_GT(damped_alone, 0);
}

TEST(PoseFit, says_why_there_is_no_pose) {
  Scene scene = make_scene(3, 3);
  EXPECT_EQ(fit(scene).status, PoseFitStatus::too_few_points);
  scene = make_scene(4, 20);
  for (std::size_t i = 0; i < 20; ++i) {
    const Eigen::Vector3d in_camera(0.1 * static_cast<double>(i) - 1, 0.2, 3);
    const Eigen::Vector3d exact = kRig.project(in_camera);
    scene.points[i] = scene.camera_from_world.inverse() * in_camera;
    scene.seen[i] = {exact.x(), exact.y()};
  }
  EXPECT_EQ(fit(scene).status, PoseFitStatus::undetermined);
  scene = make_scene(5, 20);
  const CameraFromWorld turned(Rigid3{rotation_exp({0, 3.1, 0}), {0, 0, 0}} * scene.camera_from_world);
  EXPECT_EQ(fit_pose(kRig, scene.points, scene.seen, turned).status, PoseFitStatus::behind_camera);
  EXPECT_EQ(fit(scene, {.max_iterations = 1}).status, PoseFitStatus::not_converged);
  scene.points[2].z() = std::nan("");
  EXPECT_THROW((void)fit(scene), PreconditionError);
}

}  // namespace
}  // namespace cairn
