// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/landmark_evaluation_report.h"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

#include "cairn/core/error.h"
#include "cairn/core/random.h"

namespace cairn {
namespace {

ErrorConsistency errors_of(int count) {
  Random random(6);
  ErrorCollector errors;
  for (int i = 0; i < count; ++i)
    errors.add(Eigen::Matrix<double, 1, 1>(0.02 * random.normal()), Eigen::Matrix<double, 1, 1>(4e-4));
  return errors.assess().value();
}

LandmarkEvaluationReport small_report() {
  LandmarkEvaluationReport report{"out/map", "data/street", {}, {}};
  LandmarkEvaluation& result = report.result;
  result.keyframe_pairs = 12;
  result.keyframe_error_m = 0.125;
  result.landmarks = 100;
  result.without_covariance = 3;
  result.without_truth = 7;
  result.judged = 90;
  result.at_edges = 20;
  result.all = errors_of(90);
  result.on_surface = errors_of(70);
  result.at_edge = errors_of(20);
  result.distances_m = ErrorStatistics{90, 0.05, 0.025, 0.0125, 0.02, 0, 0.5};
  result.by_distance = {{5, 10, errors_of(60)}, {80, std::numeric_limits<double>::infinity(), errors_of(30)}};
  result.by_observations = {{3, 5, errors_of(70)},
                            {17, std::numeric_limits<double>::infinity(), errors_of(20)}};
  return report;
}

TEST(LandmarkEvaluationText, counts_every_landmark) {
  const std::string text = format_landmark_evaluation_text(small_report());
  EXPECT_EQ(
      text.find("keyframes   12 in data/street, 0.125 m and 0.000 deg from the truth (medians), "
                "alignment none\n"
                "judged      90 of 100 landmarks (90.0 %), 20 of them at edges\n"
                "not judged  3 without a covariance\n"
                "not judged  7 where the truth shows nothing\n"
                "distance from the true surface, cm: median 1.25, mean 2.50, rmse 5.00, largest 50.0\n"),
      0U)
      << text;
  for (const char* row :
       {"\nall ", "\non one surface ", "\nat an edge ", "\n5 to 10 m ", "\nabove 80 m ", "\nif honest "})
    EXPECT_NE(text.find(row), std::string::npos) << row << text;
  EXPECT_NE(text.find("  1.48\n"), std::string::npos);  // of one direction
}

TEST(LandmarkEvaluationText, ends_early_if_nothing_was_judged) {
  LandmarkEvaluationReport report = small_report();
  report.result = LandmarkEvaluation{};
  EXPECT_EQ(format_landmark_evaluation_text(report).find("NEES"), std::string::npos);
  EXPECT_THROW((void)draw_landmark_coverage(report), PreconditionError);
  report.result.alignment_status = AlignmentStatus::one_line;
  EXPECT_THROW((void)format_landmark_evaluation_text(report), PreconditionError);
  const auto json = nlohmann::json::parse(format_landmark_evaluation_json(report));
  EXPECT_EQ(json["alignment_status"], "one_line");
  EXPECT_FALSE(json.contains("landmarks"));
}

TEST(LandmarkEvaluationJson, has_the_figures_in_full) {
  const auto json = nlohmann::json::parse(format_landmark_evaluation_json(small_report()));
  EXPECT_EQ(json["landmarks"], 100);
  EXPECT_EQ(json["judged"], 90);
  EXPECT_EQ(json["without_truth"], 7);
  EXPECT_EQ(json["distance_from_surface_m"]["median"], 0.0125);
  EXPECT_EQ(json["all"]["errors"], 90);
  EXPECT_EQ(json["all"]["degrees_of_freedom"], 1);
  EXPECT_EQ(json["all"]["coverage"].size(), 4U);
  EXPECT_EQ(json["on_one_surface"]["errors"], 70);
  EXPECT_EQ(json["at_an_edge"]["errors"], 20);
  ASSERT_EQ(json["by_distance"].size(), 2U);
  EXPECT_EQ(json["by_distance"][0]["below_m"], 10.0);
  EXPECT_TRUE(json["by_distance"][1]["below_m"].is_null());
  EXPECT_EQ(json["by_observations"][0]["from"], 3.0);
}

TEST(LandmarkEvaluationPlot, has_all_and_the_classes) {
  const std::string svg = draw_landmark_coverage(small_report());
  for (const char* word : {">all landmarks<", ">all: 90, ", ">at an edge: 20, ", ">5 to 10 m: 60, ",
                           "out/map against data/street"})
    EXPECT_NE(svg.find(word), std::string::npos) << word;
}

}  // namespace
}  // namespace cairn
