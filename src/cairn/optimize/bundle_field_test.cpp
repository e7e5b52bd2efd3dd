// SPDX-License-Identifier: Apache-2.0
#include "cairn/optimize/bundle_field.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "cairn/core/error.h"
#include "cairn/core/executor.h"
#include "cairn/optimize/bundle_equations.h"
#include "cairn/testing/geometry/camera_paths.h"
#include "cairn/testing/geometry/random_points.h"
#include "cairn/testing/optimize/bundle_scene.h"

namespace cairn {
namespace {

using testkit::BundleScene;
using testkit::make_bundle_scene;
using testkit::SimulatedCamera;

const DisparityField kPlanted(-0.4, 0.2, -1.0);
const BundleOptions kPrecise{
    .kernel = RobustKernel::none, .max_iterations = 50, .converged_relative_cost = 1e-12};

/// Describes a camera of a car that drives straight ahead.
struct DriveOptions {
  int cameras = 8;
  std::size_t points = 120;
  double noise = 1;  ///< standard deviations of the pixels
  DisparityField field = kPlanted;
};

constexpr SimulatedCamera kCar{{700, 700, 620, 180, 0.5}, 1240, 360};

void add_observations(Random& random, const DriveOptions& options, BundleScene& scene) {
  const testkit::PixelNoise noise{.sigma_px = 0.5, .sigma_d_px = 0.5, .scale = options.noise};
  for (std::int32_t j = 0; j < static_cast<std::int32_t>(scene.true_points.size()); ++j) {
    for (std::int32_t i = 0; i < options.cameras; ++i) {
      const Eigen::Vector3d in_camera =
          scene.true_cameras[static_cast<std::size_t>(i)] * scene.true_points[static_cast<std::size_t>(j)];
      if (in_camera.z() < 2 || !kCar.shows(kCar.rig.project(in_camera))) continue;
      Observation seen = observe(random, kCar.rig.project(in_camera), noise);
      seen.d += disparity_field_basis(kCar.rig, seen.u).dot(options.field);
      scene.problem.observations.push_back({i, j, seen});
    }
  }
}

/// Cameras 1 m apart and points on both sides, 3 to 40 m ahead of the first; camera 0 is fixed.
BundleScene make_drive(std::uint64_t seed, const DriveOptions& options = {}) {
  Random random(seed);
  BundleScene scene;
  scene.problem.rig = kCar.rig;
  for (int i = 0; i < options.cameras; ++i) {
    scene.true_cameras.push_back(testkit::small_motion(random, 0.01, 0.05) * testkit::ahead(i).inverse());
    scene.problem.camera_fixed.push_back(i == 0 ? 1 : 0);
    scene.problem.camera_from_world.push_back(i == 0 ? scene.true_cameras.back()
                                                     : testkit::small_motion(random, 0.002, 0.02) *
                                                           scene.true_cameras.back());
  }
  scene.true_points = testkit::points_in_box(random, options.points, {-15, -2, 5}, {15, 2, 40});
  for (const Eigen::Vector3d& point : scene.true_points)
    scene.problem.points_in_world.emplace_back(point + testkit::normal_vector(random, 0.05));
  add_observations(random, options, scene);
  return scene;
}

/// The length of the drive, relative to the true one.
double scale_of(const BundleScene& scene) {
  const auto& cameras = scene.problem.camera_from_world;
  return testkit::distance(cameras.front().inverse(), cameras.back().inverse()) /
         testkit::distance(scene.true_cameras.front().inverse(), scene.true_cameras.back().inverse());
}

double nees_of(const FieldReport& report, const DisparityField& truth) {
  const Eigen::Vector3d error = report.field - truth;
  return error.dot(report.covariance.inverse() * error);
}

/// Each coefficient within 4 of its standard deviations.
void expect_near(const FieldReport& report, const DisparityField& truth) {
  for (Eigen::Index i = 0; i < 3; ++i)
    EXPECT_LT(std::abs(report.field[i] - truth[i]), 4 * std::sqrt(report.covariance(i, i))) << i;
}

TEST(BundleField, reaches_the_truth_without_noise) {
  BundleScene scene = make_drive(1, {.noise = 0});
  DisparityField field = DisparityField::Zero();
  constexpr double kLoose = 1e4;  // standard deviation, pixels: the prior does not pull
  const FieldReport report = adjust_bundle_with_field(scene.problem, field, kPrecise, {kLoose});
  EXPECT_EQ(report.bundle.status, BundleStatus::ok);
  EXPECT_LT((field - kPlanted).norm(), 1e-6);
  EXPECT_EQ(field, report.field);
  EXPECT_NEAR(scale_of(scene), 1, 1e-7);
  EXPECT_EQ(report.disparities, scene.problem.observations.size());
  EXPECT_EQ(std::count(report.bundle.inlier.begin(), report.bundle.inlier.end(), 1),
            static_cast<std::ptrdiff_t>(report.disparities));
}

TEST(BundleField, finds_what_was_planted_and_the_scale) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    BundleScene scene = make_drive(seed), without = scene;
    DisparityField field = DisparityField::Zero();
    const FieldReport report = adjust_bundle_with_field(scene.problem, field, {});
    EXPECT_EQ(report.bundle.status, BundleStatus::ok);
    expect_near(report, kPlanted);
    EXPECT_LT(report.bundle.cost_after, report.bundle.cost_before);
    (void)adjust_bundle(without.problem, {});
    EXPECT_NEAR(scale_of(scene), 1, 0.01);
    EXPECT_GT(std::abs(scale_of(without) - 1), 3 * std::abs(scale_of(scene) - 1));
  }
}

TEST(BundleField, stays_near_zero_where_there_is_none) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    BundleScene scene = make_drive(seed, {.field = DisparityField::Zero()});
    DisparityField field = DisparityField::Zero();
    expect_near(adjust_bundle_with_field(scene.problem, field, {}), DisparityField::Zero());
  }
}

/// Normalised estimation error squared: 3 on average where the covariance is honest.
TEST(BundleField, has_an_honest_covariance) {
  constexpr int kSeeds = 100;
  double nees = 0;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    BundleScene scene = make_drive(100 + seed, {.cameras = 6, .points = 80});
    DisparityField field = DisparityField::Zero();
    nees += nees_of(adjust_bundle_with_field(scene.problem, field, kPrecise, {10}), kPlanted) / kSeeds;
  }
  EXPECT_NEAR(nees, 3, 4 * std::sqrt(6.0 / kSeeds));
}

/// All unknowns of a small problem in one vector: free cameras, points, field; errors by finite differences.
class DenseProblem {
 public:
  DenseProblem(const BundleProblem& problem, const DisparityField& field, double prior_sigma_px)
      : problem_(problem), field_(field), prior_sigma_px_(prior_sigma_px) {
    for (const char fixed : problem.camera_fixed) {
      begin_.push_back(fixed != 0 ? -1 : first_point_);
      if (fixed == 0) first_point_ += 6;
    }
    size_ = first_point_ + 3 * static_cast<Eigen::Index>(problem.points_in_world.size()) + 3;
  }

  [[nodiscard]] Eigen::Index size() const { return size_; }
  [[nodiscard]] Eigen::Index first_point() const { return first_point_; }

  /// Three rows an observation and three of the prior, in standard deviations.
  [[nodiscard]] Eigen::VectorXd errors(const Eigen::VectorXd& step) const {
    const Eigen::Vector3d field = field_ + step.tail<3>();
    Eigen::VectorXd errors(3 * static_cast<Eigen::Index>(problem_.observations.size()) + 3);
    Eigen::Index row = 0;
    for (const BundleObservation& observation : problem_.observations) {
      errors.segment<3>(row) = error_of(observation, step, field);
      row += 3;
    }
    errors.tail<3>() = field / prior_sigma_px_;
    return errors;
  }

  [[nodiscard]] Eigen::MatrixXd jacobian() const {
    constexpr double kStep = 1e-6;
    Eigen::MatrixXd jacobian(3 * static_cast<Eigen::Index>(problem_.observations.size()) + 3, size_);
    for (Eigen::Index i = 0; i < size_; ++i) {
      const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(size_, i);
      jacobian.col(i) = (errors(step) - errors(-step)) / (2 * kStep);
    }
    return jacobian;
  }

  /// The weight of each row by Huber's kernel.
  [[nodiscard]] Eigen::VectorXd weights(const BundleOptions& options) const {
    const Eigen::VectorXd errors = this->errors(Eigen::VectorXd::Zero(size_));
    Eigen::VectorXd weights = Eigen::VectorXd::Ones(errors.size());
    for (Eigen::Index row = 0; row + 3 < errors.size(); row += 3)
      weights.segment<3>(row).setConstant(
          kernel_weight(options.kernel, options.kernel_scale, errors.segment<3>(row).squaredNorm()));
    return weights;
  }

 private:
  [[nodiscard]] Eigen::Vector3d error_of(const BundleObservation& observation, const Eigen::VectorXd& step,
                                         const Eigen::Vector3d& field) const {
    const auto& [camera, point, seen] = observation;
    Rigid3 pose = problem_.camera_from_world[static_cast<std::size_t>(camera)];
    const Eigen::Index at = begin_[static_cast<std::size_t>(camera)];
    if (at >= 0) pose = perturb_left(step.segment<6>(at), pose);
    const Eigen::Vector3d moved =
        problem_.points_in_world[static_cast<std::size_t>(point)] + step.segment<3>(first_point_ + 3 * point);
    Eigen::Vector3d error = problem_.rig.project(pose * moved) - Eigen::Vector3d(seen.u, seen.v, 0);
    error.head<2>() /= seen.sigma_px;
    if (!seen.has_disparity()) return {error.x(), error.y(), 0};
    error.z() += disparity_field_basis(problem_.rig, seen.u).dot(field) - seen.d;
    return {error.x(), error.y(), error.z() / seen.sigma_d_px};
  }

  const BundleProblem& problem_;
  DisparityField field_;
  double prior_sigma_px_;
  std::vector<Eigen::Index> begin_;  // by camera; -1 if it is fixed
  Eigen::Index first_point_ = 0, size_ = 0;
};

/// The equations with a field at the start of a small problem, beside those written out.
class TwoWays {
 public:
  explicit TwoWays(int fixed)
      : problem_(make_problem(fixed)),
        structure_(analyse_bundle(problem_)),
        border_(problem_.rig, structure_, kPriorSigma),
        equations_(problem_.rig, structure_, options_, executor_, &border_),
        from_(problem_, structure_),
        dense_(problem_, {0.3, -0.2, 0.5}, kPriorSigma) {
    from_.field = {0.3, -0.2, 0.5};
    equations_.evaluate_costs(from_);
    const Eigen::MatrixXd jacobian = dense_.jacobian();
    const Eigen::VectorXd weights = dense_.weights(options_);
    hessian_ = jacobian.transpose() * weights.asDiagonal() * jacobian;
    gradient_ = jacobian.transpose() * weights.cwiseProduct(dense_.errors(Eigen::VectorXd::Zero(size())));
  }

  void expect_same_step(double lambda) {
    equations_.build(from_, lambda);
    ASSERT_TRUE(equations_.solve());
    BundleState to = from_;
    equations_.move(from_, to);
    Eigen::MatrixXd damped = hessian_;
    damped.diagonal() *= 1 + lambda;
    const Eigen::VectorXd step = -damped.llt().solve(gradient_);
    EXPECT_GT(step.tail<3>().norm(), 0.01);
    EXPECT_LT((steps_to(to) - step).cwiseAbs().maxCoeff(), kNear);
  }

  void expect_same_covariance() {
    equations_.build(from_, 0);
    ASSERT_TRUE(equations_.solve());
    const Eigen::Matrix3d covariance =
        hessian_.llt().solve(Eigen::MatrixXd::Identity(size(), size())).bottomRightCorner<3, 3>();
    EXPECT_LT((border_.covariance() - covariance).norm(), kNear * covariance.norm());
  }

 private:
  static constexpr double kPriorSigma = 0.3;
  static constexpr double kNear = 1e-6;  // of finite differences

  static BundleProblem make_problem(int fixed) {
    return make_bundle_scene(1, {.cameras = 5, .fixed = fixed, .points = 30, .disparity_share = 0.6}).problem;
  }
  [[nodiscard]] Eigen::Index size() const { return dense_.size(); }

  /// In the order of the dense problem.
  [[nodiscard]] Eigen::VectorXd steps_to(const BundleState& to) const {
    Eigen::VectorXd steps = Eigen::VectorXd::Zero(size());
    for (std::size_t i = 0; i < structure_.free_cameras.size(); ++i) {
      const auto camera = static_cast<std::size_t>(structure_.free_cameras[i]);
      steps.segment<6>(6 * static_cast<Eigen::Index>(i)) =
          left_perturbation(from_.camera_from_world[camera], to.camera_from_world[camera]);
    }
    for (std::size_t j = 0; j < structure_.points.size(); ++j)
      steps.segment<3>(dense_.first_point() + 3 * structure_.points[j]) = to.points[j] - from_.points[j];
    steps.tail<3>() = to.field - from_.field;
    return steps;
  }

  BundleProblem problem_;
  BundleStructure structure_;
  BundleOptions options_;
  Executor executor_;
  FieldBorder border_;
  BundleEquations equations_;
  BundleState from_;
  DenseProblem dense_;
  Eigen::MatrixXd hessian_;
  Eigen::VectorXd gradient_;
};

TEST(BundleField, takes_the_step_of_the_full_normal_equations) {
  for (const int fixed : {2, 5}) {  // all of them, too
    TwoWays ways(fixed);
    ways.expect_same_step(0.01);
    ways.expect_same_step(0);
    ways.expect_same_covariance();
  }
}

TEST(BundleField, repeats_its_bits_at_any_number_of_threads) {
  const BundleScene scene =
      make_bundle_scene(7, {.cameras = 50, .points = 700, .disparity_share = 0.5, .outlier_share = 0.1});
  BundleProblem one = scene.problem;
  DisparityField field = DisparityField::Zero();
  const FieldReport report = adjust_bundle_with_field(one, field, {});
  EXPECT_NE(field, DisparityField::Zero());
  for (const int threads : {2, 3}) {
    BundleProblem other = scene.problem;
    DisparityField again_field = DisparityField::Zero();
    const FieldReport again = adjust_bundle_with_field(other, again_field, {}, {}, Executor(threads));
    EXPECT_EQ(again_field, field) << threads;
    EXPECT_EQ(again.covariance, report.covariance);
    EXPECT_EQ(again.bundle.cost_after, report.bundle.cost_after);
    EXPECT_EQ(again.bundle.inlier, report.bundle.inlier);
    EXPECT_EQ(other.points_in_world, one.points_in_world);
    for (std::size_t i = 0; i < 50; ++i)
      EXPECT_EQ(other.camera_from_world[i].translation, one.camera_from_world[i].translation) << i;
  }
}

TEST(BundleField, is_the_prior_without_any_disparity) {
  BundleScene scene = make_bundle_scene(2, {.disparity_share = 0}), plain = scene;
  DisparityField field = DisparityField::Zero();
  const FieldReport report = adjust_bundle_with_field(scene.problem, field, {}, {0.3});
  EXPECT_EQ(report.bundle.status, BundleStatus::ok);
  EXPECT_EQ(report.disparities, 0U);
  EXPECT_EQ(field, DisparityField::Zero());
  EXPECT_LT((report.covariance - 0.09 * Eigen::Matrix3d::Identity()).norm(), 1e-15);
  (void)adjust_bundle(plain.problem, {});
  EXPECT_EQ(scene.problem.points_in_world, plain.problem.points_in_world);
  field = {0.2, 0, 0};
  (void)adjust_bundle_with_field(scene.problem, field, kPrecise);
  EXPECT_LT(field.norm(), 1e-6);
}

TEST(BundleField, needs_no_fixed_camera) {
  BundleScene scene = make_drive(3), free = scene;
  free.problem.camera_fixed[0] = 0;
  DisparityField field = DisparityField::Zero(), free_field = field;
  const FieldReport report = adjust_bundle_with_field(scene.problem, field, kPrecise);
  const FieldReport without = adjust_bundle_with_field(free.problem, free_field, kPrecise);
  EXPECT_EQ(without.bundle.status, BundleStatus::ok);
  EXPECT_LT((free_field - field).norm(), 1e-4);
  EXPECT_LT((without.covariance - report.covariance).norm(), 1e-4 * report.covariance.norm());
}

TEST(BundleField, refuses_what_makes_no_sense) {
  BundleProblem problem = make_bundle_scene(12).problem;
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  DisparityField field(0, kNan, 0), zero = DisparityField::Zero();
  EXPECT_THROW((void)adjust_bundle_with_field(problem, field, {}), PreconditionError);
  EXPECT_THROW((void)adjust_bundle_with_field(problem, zero, {}, {0}), PreconditionError);
  EXPECT_THROW((void)adjust_bundle_with_field(problem, zero, {}, {kNan}), PreconditionError);
  problem.observations.clear();
  const FieldReport report = adjust_bundle_with_field(problem, zero, {}, {2});
  EXPECT_EQ(report.bundle.status, BundleStatus::nothing_free);
  EXPECT_EQ(report.covariance, 4 * Eigen::Matrix3d::Identity());
}

}  // namespace
}  // namespace cairn
