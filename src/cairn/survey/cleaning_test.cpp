// SPDX-License-Identifier: Apache-2.0
#include "cairn/survey/cleaning.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <set>
#include <vector>

namespace cairn {
namespace {

/// Limits of every kind, each with a landmark that just holds against all of them.
CleaningOptions all_limits() {
  CleaningOptions options;
  options.min_frames = 3;
  options.max_std_m = 0.5;
  options.max_rms_px = 1.5;
  options.min_ray_angle_deg = 0.25;
  options.depth = {.min = 2, .max = 50, .max_mean = 30, .max_std = 10};
  options.distance = {.min = 3, .max = 60, .max_mean = 40, .max_std = 12};
  options.lateral = {.min = 1, .max = 20, .max_mean = 15, .max_std = 6};
  options.angle_deg = {.min = 0.5, .max = 45, .max_mean = 35, .max_std = 9};
  return options;
}

LandmarkIndicators on_the_limits() {
  LandmarkIndicators indicators;
  indicators.frames = 3;
  indicators.rms_px = 1.5;
  indicators.max_ray_angle_deg = 0.25;
  indicators.depth = {.mean = 30, .min = 2, .max = 50, .std = 10};
  indicators.distance = {.mean = 40, .min = 3, .max = 60, .std = 12};
  indicators.lateral = {.mean = 15, .min = 1, .max = 20, .std = 6};
  indicators.angle_deg = {.mean = 35, .min = 0.5, .max = 45, .std = 9};
  return indicators;
}

Eigen::Matrix3d good_covariance() {
  return 0.01 * Eigen::Matrix3d::Identity();
}

TEST(Cleaning, limits_are_inclusive) {
  EXPECT_EQ(failed_rule(on_the_limits(), good_covariance(), all_limits()), std::nullopt);
}

TEST(Cleaning, each_rule_has_its_landmark) {
  constexpr double kBit = 1e-6;
  using Change = std::function<void(LandmarkIndicators&)>;
  struct Row {
    CleaningRule rule;
    Change change;
  };
  const std::vector<Row> rows = {
      {CleaningRule::frames, [](auto& figures) { figures.frames = 2; }},
      {CleaningRule::rms, [](auto& figures) { figures.rms_px += kBit; }},
      {CleaningRule::ray_angle, [](auto& figures) { figures.max_ray_angle_deg -= kBit; }},
      {CleaningRule::depth, [](auto& figures) { figures.depth.min -= kBit; }},
      {CleaningRule::depth, [](auto& figures) { figures.depth.max += kBit; }},
      {CleaningRule::depth, [](auto& figures) { figures.depth.mean += kBit; }},
      {CleaningRule::depth, [](auto& figures) { figures.depth.std += kBit; }},
      {CleaningRule::distance, [](auto& figures) { figures.distance.min -= kBit; }},
      {CleaningRule::distance, [](auto& figures) { figures.distance.max += kBit; }},
      {CleaningRule::distance, [](auto& figures) { figures.distance.mean += kBit; }},
      {CleaningRule::distance, [](auto& figures) { figures.distance.std += kBit; }},
      {CleaningRule::lateral, [](auto& figures) { figures.lateral.min -= kBit; }},
      {CleaningRule::lateral, [](auto& figures) { figures.lateral.max += kBit; }},
      {CleaningRule::lateral, [](auto& figures) { figures.lateral.mean += kBit; }},
      {CleaningRule::lateral, [](auto& figures) { figures.lateral.std += kBit; }},
      {CleaningRule::view_angle, [](auto& figures) { figures.angle_deg.min -= kBit; }},
      {CleaningRule::view_angle, [](auto& figures) { figures.angle_deg.max += kBit; }},
      {CleaningRule::view_angle, [](auto& figures) { figures.angle_deg.mean += kBit; }},
      {CleaningRule::view_angle, [](auto& figures) { figures.angle_deg.std += kBit; }},
  };
  for (std::size_t i = 0; i < rows.size(); ++i) {
    LandmarkIndicators indicators = on_the_limits();
    rows[i].change(indicators);
    EXPECT_EQ(failed_rule(indicators, good_covariance(), all_limits()), rows[i].rule) << i;
    CleaningOptions none = all_limits();
    none.depth = none.distance = none.lateral = none.angle_deg = {};
    if (rows[i].rule >= CleaningRule::depth) {
      EXPECT_EQ(failed_rule(indicators, good_covariance(), none), std::nullopt) << i;
    }
  }
}

TEST(Cleaning, asks_for_the_worst_direction) {
  const Eigen::Quaterniond turned(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()));
  const auto covariance = [&](double worst_std) -> Eigen::Matrix3d {
    return turned * Eigen::Vector3d(0.01, worst_std * worst_std, 0.02).asDiagonal() *
           turned.conjugate().toRotationMatrix();
  };
  EXPECT_EQ(failed_rule(on_the_limits(), covariance(0.4999), all_limits()), std::nullopt);
  EXPECT_EQ(failed_rule(on_the_limits(), covariance(0.5001), all_limits()), CleaningRule::position_std);
}

TEST(Cleaning, a_covariance_that_is_no_number_falls) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Eigen::Matrix3d covariance = good_covariance();
    covariance(1, 1) = bad;
    EXPECT_EQ(failed_rule(on_the_limits(), covariance, all_limits()), CleaningRule::position_std);
    covariance = good_covariance();
    covariance(0, 2) = covariance(2, 0) = bad;
    EXPECT_EQ(failed_rule(on_the_limits(), covariance, all_limits()), CleaningRule::position_std);
  }
}

TEST(Cleaning, a_figure_that_is_no_number_falls) {
  LandmarkIndicators indicators = on_the_limits();
  indicators.rms_px = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(failed_rule(indicators, good_covariance(), all_limits()), CleaningRule::rms);
  indicators = on_the_limits();
  indicators.depth.max = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(failed_rule(indicators, good_covariance(), all_limits()), CleaningRule::depth);
}

TEST(Cleaning, the_first_rule_is_named) {
  LandmarkIndicators indicators = on_the_limits();
  indicators.frames = 2;
  indicators.rms_px = 9;
  EXPECT_EQ(failed_rule(indicators, good_covariance(), all_limits()), CleaningRule::frames);
}

TEST(Cleaning, each_rule_has_a_name) {
  std::set<std::string_view> names;
  for (std::size_t i = 0; i < kCleaningRules; ++i) names.insert(to_string(static_cast<CleaningRule>(i)));
  EXPECT_EQ(names.size(), kCleaningRules);
  EXPECT_EQ(to_string(CleaningRule::view_angle), "view_angle");
}

}  // namespace
}  // namespace cairn
