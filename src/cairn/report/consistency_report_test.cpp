// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/consistency_report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <numbers>

#include "cairn/core/random.h"
#include "cairn/report/test_evaluation.h"

namespace cairn {
namespace {

/// Errors of `size` numbers, each with the standard deviation `sigma` and twice that stated.
ErrorConsistency twice_as_sure(int size, double sigma, int count = 100) {
  Random random(4);
  ErrorCollector errors;
  for (int i = 0; i < count; ++i) {
    Eigen::VectorXd error(size);
    for (double& value : error) value = sigma * random.normal();
    errors.add(error, 4 * sigma * sigma * Eigen::MatrixXd::Identity(size, size));
  }
  return errors.assess().value();
}

StatedPoses stated(CovarianceScope scope, bool is_weak = false) {
  return {scope, is_weak, 2, 1,
          PoseConsistency{twice_as_sure(6, 0.01), twice_as_sure(3, 0.01), twice_as_sure(3, 0.001)}};
}

EvaluationReport report_with(const std::vector<StatedPoses>& covariances) {
  EvaluationReport report = small_evaluation();
  report.estimates[0].covariances = covariances;
  return report;
}

TEST(ConsistencyText, has_a_row_for_pose_position_and_rotation) {
  const std::string text = format_stated_poses(report_with({stated(CovarianceScope::absolute)}));
  EXPECT_EQ(text, R"(
covariances, se3  poses  NEES/dof  NEES/dof  in 50 %  in 68 %  in 95 %  in 99 %  stated std       error  std/error  if honest
                             mean    median        %        %        %        %      median      median
absolute: pose      100     0.245     0.275    100.0    100.0    100.0    100.0
  position          100     0.217     0.216    100.0    100.0    100.0    100.0     3.46 cm     1.43 cm       2.42       1.13
  rotation          100     0.217     0.216    100.0    100.0    100.0    100.0   0.198 deg  0.0819 deg       2.42       1.13
if honest                       1         1     50.0     68.0     95.0     99.0
absolute: 2 without a pose of REF
absolute: 1 without a covariance
The alignment hides the part of the error that all poses have in common; --align none shows it.
)");
}

TEST(ConsistencyText, says_what_an_alignment_hides) {
  EvaluationReport report = report_with({stated(CovarianceScope::in_map)});
  EXPECT_NE(format_stated_poses(report).find("The alignment hides the part"), std::string::npos);
  report.options.alignment = AlignmentMode::none;
  EXPECT_EQ(format_stated_poses(report).find("The alignment hides"), std::string::npos);
  report = report_with({stated(CovarianceScope::from_first)});  // motions know no world
  EXPECT_EQ(format_stated_poses(report).find("The alignment hides"), std::string::npos);
}

TEST(ConsistencyText, says_nothing_if_nothing_was_stated) {
  EXPECT_EQ(format_stated_poses(small_evaluation()), "");
  EXPECT_EQ(format_evaluation_text(small_evaluation()).find("covariances"), std::string::npos);
  EXPECT_NE(format_evaluation_text(report_with({stated(CovarianceScope::in_map)})).find("\ncovariances, se3"),
            std::string::npos);
}

TEST(ConsistencyText, names_the_estimate_if_there_are_several) {
  EvaluationReport report = two_evaluations();
  report.estimates[0].covariances = {stated(CovarianceScope::in_map, true)};
  EXPECT_NE(format_stated_poses(report).find("\nrun/trajectory.txt in the map, weak poses: pose"),
            std::string::npos)
      << format_stated_poses(report);
}

TEST(ConsistencyJson, has_the_figures_in_full) {
  const EvaluationReport report = report_with({stated(CovarianceScope::from_previous)});
  const auto json = nlohmann::json::parse(format_evaluation_json(report));
  ASSERT_EQ(json["covariances"].size(), 1U);
  const auto& one = json["covariances"][0];
  EXPECT_EQ(one["scope"], "from_previous");
  EXPECT_EQ(one["weak"], false);
  EXPECT_EQ(one["without_truth"], 2);
  EXPECT_EQ(one["without_covariance"], 1);
  EXPECT_EQ(one["pose"]["degrees_of_freedom"], 6);
  EXPECT_FALSE(one["pose"].contains("median_error_m"));
  EXPECT_NEAR(one["position"]["mean_nees_per_dof"].get<double>(), 0.25, 0.04);
  EXPECT_EQ(one["position"]["verdict"], "pessimistic");
  EXPECT_EQ(one["position"]["coverage"].size(), 4U);
  EXPECT_EQ(one["position"]["coverage"][2]["nominal"], 0.95);
  EXPECT_NEAR(one["position"]["median_std_m"].get<double>(), 0.02 * std::numbers::sqrt3, 1e-12);
  EXPECT_NEAR(one["position"]["std_per_error"].get<double>(), 2.25, 0.25);
  EXPECT_NEAR(one["rotation"]["median_std_deg"].get<double>(),
              0.002 * std::numbers::sqrt3 * (180 / std::numbers::pi), 1e-12);
  EXPECT_FALSE(nlohmann::json::parse(format_evaluation_json(small_evaluation())).contains("covariances"));
}

TEST(ConsistencyPlot, has_a_panel_for_each_set) {
  StatedPoses unknown{CovarianceScope::in_map, true, 3, 0, {}};
  const std::string svg = draw_coverage(
      report_with({stated(CovarianceScope::absolute), stated(CovarianceScope::in_map), unknown}));
  EXPECT_NE(svg.find(">absolute<"), std::string::npos);
  EXPECT_NE(svg.find(">in the map<"), std::string::npos);
  EXPECT_EQ(svg.find("weak"), std::string::npos);
  EXPECT_NE(svg.find("run/trajectory.txt against room/groundtruth.txt, alignment se3"), std::string::npos);
  EXPECT_NE(svg.find(">position: 100, NEES/dof 0.2"), std::string::npos);
}

}  // namespace
}  // namespace cairn
