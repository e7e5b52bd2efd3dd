// SPDX-License-Identifier: Apache-2.0
#include "cairn/optimize/landmark_noise.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <vector>

#include "cairn/core/random.h"
#include "cairn/optimize/landmark_fit.h"

namespace cairn {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr Rig kRig{500, 500, 320, 240, 0.5};
constexpr int kCameras = 12;

/// Cameras that drive ahead, a metre apart.
std::vector<CameraFromWorld> cameras() {
  std::vector<CameraFromWorld> all;
  for (int i = 0; i < kCameras; ++i)
    all.push_back(WorldFromCamera({Eigen::Quaterniond::Identity(), {0, 0, 1.0 * i}}).inverse());
  return all;
}

/// True noise of simulated observations, times what they state.
struct Truth {
  double pixels = 1, disparities = 1;  ///< variances of independent errors
  double common = 0;                   ///< variance of the pixels' common error, per observation
  double freedom = 1e6;                ///< of the landmarks' own factors
};

struct SimulatedLandmark {
  Vector3d point;
  std::vector<CameraObservation> observations;
};

class LandmarkNoiseTest : public testing::Test {
 protected:
  /// Simulates a landmark beside the road, seen by 3 to 12 cameras. What pixels have in common moves the
  /// point that they see by a multiple of the covariance that they give it.
  SimulatedLandmark simulate(const Truth& truth) {
    SimulatedLandmark landmark;
    const auto count = static_cast<int>(3 + random_.index(kCameras - 2));
    landmark.point = {random_.uniform(-6, 6), random_.uniform(-2, 2),
                      random_.uniform(kCameras + 4, kCameras + 25)};
    const double factor = own_factor(truth.freedom);
    for (int i = 0; i < count; ++i) landmark.observations.push_back({i, {}});
    place(landmark.point, landmark);
    const Vector3d seen_by_pixels =
        landmark.point + std::sqrt(factor * truth.common * count) * error_of_pixels(landmark);
    for (auto& [camera, seen] : landmark.observations) {
      const Vector3d shown = kRig.project(cameras_[static_cast<std::size_t>(camera)] * seen_by_pixels);
      seen.u = shown.x() + std::sqrt(factor * truth.pixels) * seen.sigma_px * random_.normal();
      seen.v = shown.y() + std::sqrt(factor * truth.pixels) * seen.sigma_px * random_.normal();
      seen.d += std::sqrt(factor * truth.disparities) * seen.sigma_d_px * random_.normal();
    }
    return landmark;
  }

  LandmarkInformation fitted(const SimulatedLandmark& landmark, Vector3d& point) {
    const LandmarkFit fit = fit_landmark(kRig, cameras_, landmark.observations, {.max_error = 1e3});
    EXPECT_EQ(fit.status, LandmarkFitStatus::ok);
    point = fit.point_in_world;
    return information_of(kRig, cameras_, landmark.observations, point);
  }

  LandmarkNoiseModel model_of(const Truth& truth, int landmarks) {
    LandmarkNoiseModel model;
    Vector3d point;
    for (int i = 0; i < landmarks; ++i) model.add(fitted(simulate(truth), point).errors);
    return model;
  }

  /// Returns the mean of NEES per degree of freedom over fresh landmarks.
  double consistency(const LandmarkNoise& noise, const Truth& truth, int landmarks) {
    double sum = 0;
    for (int i = 0; i < landmarks; ++i) {
      const SimulatedLandmark landmark = simulate(truth);
      Vector3d point;
      const Matrix3d covariance = noise.covariance_of(fitted(landmark, point));
      const Vector3d error = point - landmark.point;
      sum += error.dot(covariance.inverse() * error) / 3;
    }
    return sum / landmarks;
  }

  Random random_{7};
  std::vector<CameraFromWorld> cameras_ = cameras();

 private:
  double own_factor(double freedom) {
    if (freedom > 1e5) return 1;
    double sum = 0;
    for (int i = 0; i < static_cast<int>(freedom); ++i) sum += std::pow(random_.normal(), 2);
    return freedom / sum;
  }
  void place(const Vector3d& point, SimulatedLandmark& landmark) const {
    for (auto& [camera, seen] : landmark.observations) {
      const Vector3d shown = kRig.project(cameras_[static_cast<std::size_t>(camera)] * point);
      seen = {shown.x(), shown.y(), shown.z(), 0.5, 0.5};
    }
  }
  Vector3d error_of_pixels(const SimulatedLandmark& landmark) {
    const auto information = information_of(kRig, cameras_, landmark.observations, landmark.point);
    const Vector3d normal(random_.normal(), random_.normal(), random_.normal());
    return information.pixels.inverse().llt().matrixL() * normal;
  }
};

TEST_F(LandmarkNoiseTest, information_is_that_of_the_fit) {
  for (int i = 0; i < 20; ++i) {
    const SimulatedLandmark landmark = simulate({});
    const LandmarkFit fit = fit_landmark(kRig, cameras_, landmark.observations, {.max_error = 1e3});
    const auto found = information_of(kRig, cameras_, landmark.observations, fit.point_in_world);
    EXPECT_EQ(found.errors.observations, static_cast<double>(landmark.observations.size()));
    EXPECT_NEAR(found.errors.pixel_errors + found.errors.disparity_errors, fit.squared_error_sum,
                1e-6 * fit.squared_error_sum);
    EXPECT_NEAR(found.errors.pixel_redundancy + found.errors.disparity_redundancy, fit.redundancy, 1e-9);
    const Matrix3d covariance = (found.pixels + found.disparities).inverse();
    EXPECT_LT((covariance - fit.covariance).norm(), 1e-4 * covariance.norm());
    EXPECT_GT(found.errors.disparity_share, 0);
    EXPECT_LT(found.errors.disparity_share, 1);
  }
}

TEST_F(LandmarkNoiseTest, one_camera_knows_the_depth_by_disparity_alone) {
  SimulatedLandmark landmark = simulate({});
  landmark.observations.resize(1);
  const auto found = information_of(kRig, cameras_, landmark.observations, landmark.point);
  EXPECT_NEAR(found.errors.disparity_share, 1, 1e-9);
  EXPECT_EQ(found.errors.disagreement, 0);
  EXPECT_NEAR(found.errors.pixel_redundancy, 0, 1e-9);
  EXPECT_NEAR(found.errors.disparity_redundancy, 0, 1e-9);
}

TEST_F(LandmarkNoiseTest, pixels_alone_have_no_disparities) {
  SimulatedLandmark landmark = simulate({});
  for (auto& [camera, seen] : landmark.observations) seen = without_disparity(seen);
  const auto found = information_of(kRig, cameras_, landmark.observations, landmark.point);
  EXPECT_TRUE(found.disparities.isZero(0));
  EXPECT_EQ(found.errors.disparity_share, 0);
  EXPECT_EQ(found.errors.disagreement, 0);
  EXPECT_TRUE(LandmarkNoise{}.covariance_of(found).allFinite());
}

TEST_F(LandmarkNoiseTest, is_the_variance_factor_alone_while_little_is_known) {
  const LandmarkNoiseModel model = model_of({.pixels = 9, .disparities = 9}, 127);
  Vector3d point;
  const LandmarkInformation landmark = fitted(simulate({}), point);
  const double factor =
      VariancePrior{}.factor(landmark.errors.pixel_errors + landmark.errors.disparity_errors,
                             landmark.errors.pixel_redundancy + landmark.errors.disparity_redundancy);
  const Matrix3d expected = factor * (landmark.pixels + landmark.disparities).inverse();
  EXPECT_LT((model.noise().covariance_of(landmark) - expected).norm(), 1e-9 * expected.norm());
}

TEST_F(LandmarkNoiseTest, covariances_hold_for_independent_errors) {
  for (const Truth truth :
       {Truth{}, Truth{.pixels = 0.1, .disparities = 1}, Truth{.pixels = 2, .disparities = 0.2}}) {
    const LandmarkNoise noise = model_of(truth, 4096).noise();
    EXPECT_NEAR(consistency(noise, truth, 3000), 1, 0.12) << truth.pixels << " " << truth.disparities;
  }
}

TEST_F(LandmarkNoiseTest, covariances_hold_where_pixels_err_alike) {
  const Truth truth{.pixels = 0.3, .disparities = 0.3, .common = 0.1};
  const LandmarkNoise noise = model_of(truth, 4096).noise();
  EXPECT_NEAR(consistency(noise, truth, 3000), 1, 0.12);
  const LandmarkNoise blind = model_of({.pixels = 0.3, .disparities = 0.3}, 4096).noise();
  EXPECT_GT(consistency(blind, truth, 3000), 1.5);
}

TEST_F(LandmarkNoiseTest, covariances_hold_where_some_landmarks_are_blurred) {
  const Truth truth{.pixels = 0.5, .disparities = 0.5, .freedom = 6};
  EXPECT_NEAR(consistency(model_of(truth, 4096).noise(), truth, 5000), 1, 0.15);
}

TEST_F(LandmarkNoiseTest, goes_on_with_what_was_stored) {
  LandmarkNoiseModel model = model_of({}, 4500);
  LandmarkNoiseModel restored(std::vector(model.samples()), model.count(), model.noise());
  Vector3d point;
  for (int i = 0; i < 2000; ++i) {
    const LandmarkInformation landmark = fitted(simulate({.pixels = 2}), point);
    model.add(landmark.errors);
    restored.add(landmark.errors);
  }
  EXPECT_EQ(model.samples().size(), 4096U);
  EXPECT_EQ(model.noise().pixels, restored.noise().pixels);
  EXPECT_EQ(model.noise().disparities, restored.noise().disparities);
  EXPECT_EQ(model.noise().own.scale, restored.noise().own.scale);
}

TEST_F(LandmarkNoiseTest, knows_nothing_of_an_open_point) {
  const LandmarkInformation open = information_of(kRig, cameras_, {}, {0, 0, 5});
  const Matrix3d covariance = LandmarkNoise{}.covariance_of(open);
  EXPECT_EQ(covariance(1, 1), std::numeric_limits<double>::infinity());
  EXPECT_EQ(covariance(0, 1), 0);
  LandmarkNoiseModel model;
  model.add(open.errors);
  EXPECT_EQ(model.count(), 0);
}

}  // namespace
}  // namespace cairn
