// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/evaluation_report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <numbers>

#include "cairn/core/error.h"
#include "cairn/report/test_evaluation.h"

namespace cairn {
namespace {

TEST(EvaluationText, has_all_figures_of_one_estimate) {
  EvaluationReport report = small_evaluation();
  report.tolerances = {{0.02, 5}};
  report.queries = 8;
  EXPECT_EQ(format_evaluation_text(report),
            R"(pairs      4 (100.0 % of EST, 80.0 % of REF), stamps within 0.02 s
alignment  se3: turned 0.00 deg, moved 5.000 m
scale      1.062500 by sim3

                       number      rmse      mean    median       std       min       max
ATE se3            cm       4     2.750     2.500     2.400     1.100     1.000     4.000
ATE sim3           cm       4     1.250     2.500     2.400     1.100     1.000     4.000
ATE rotation      deg       4     2.750     2.500     2.400     1.100     1.000     4.000
RPE 1 frame        cm       3    50.000    40.000    30.000    20.000    10.000    60.000
                  deg       3     5.000     4.000     3.000     2.000     1.000     6.000
no RPE over 2.5 m: there is no such interval among the pairs

percentiles, se3   50 %   90 %   95 %   99 %   50 %   90 %   95 %   99 %
                     cm     cm     cm     cm    deg    deg    deg    deg
EST               2.500  3.700  3.850  3.970  2.500  3.700  3.850  3.970

within 0.02 m and 5 deg  poses  of the pairs       of EST       of REF  of the queries
EST                          2   50.0 % of 4  50.0 % of 4  40.0 % of 5     25.0 % of 8
)");
}

TEST(EvaluationText, tells_the_drift_and_metres_of_large_errors) {
  EvaluationReport report = small_evaluation();
  report.has_times = false;
  report.options.alignment = AlignmentMode::none;
  TrajectoryEvaluation& result = report.estimates[0].result;
  result.absolute.ate_m->max = 12;
  result.drift = Drift{{0, 9, 1.25, 0.0005}, {{100, 5, 1.5, 0.00025}}};
  const std::string text = format_evaluation_text(report);
  EXPECT_NE(text.find(", by their order, as no file has time stamps\nalignment  none: both in one frame\n"),
            std::string::npos);
  EXPECT_NE(text.find("\nATE none            m       4     0.028 "), std::string::npos);
  EXPECT_NE(text.find("\ndrift of KITTI   segments  translation     rotation\n"
                      "100 m                   5     1.5000 %     0.000250 deg/m\n"
                      "all                     9     1.2500 %     0.000500 deg/m\n"),
            std::string::npos);
}

TEST(EvaluationText, has_a_row_for_each_of_several) {
  EvaluationReport report = two_evaluations();
  report.tolerances = {{0.5, 10}};
  EXPECT_EQ(format_evaluation_text(report),
            R"(reference  data/room/groundtruth.txt, 5 poses; stamps within 0.02 s; all but ATE aligned by se3

                    pairs  ATE se3  ATE sim3   scale  ATE rot.  RPE 1 frame         RPE 2.5 m       drift
rmse                            cm        cm               deg           cm    deg         cm  deg      %  deg/m
run/trajectory.txt      4    2.750     1.250  1.0625     2.750       50.000  5.000          -    -      -      -
other.txt               0        -         -       -         -            -      -          -    -      -      -

percentiles, se3     50 %   90 %   95 %   99 %   50 %   90 %   95 %   99 %
                       cm     cm     cm     cm    deg    deg    deg    deg
run/trajectory.txt  2.500  3.700  3.850  3.970  2.500  3.700  3.850  3.970
other.txt               -      -      -      -      -      -      -      -

within 0.5 m and 10 deg  poses  of the pairs        of EST       of REF
run/trajectory.txt           4  100.0 % of 4  100.0 % of 4  80.0 % of 5
other.txt                    -             -             -            -
)");
}

TEST(EvaluationText, refuses_a_single_estimate_without_alignment) {
  EvaluationReport report = small_evaluation();
  report.estimates[0].result.status = EvaluationStatus::no_pairs;
  EXPECT_THROW((void)format_evaluation_text(report), PreconditionError);
}

TEST(EvaluationJson, has_the_figures_of_one_estimate_in_full) {
  EvaluationReport report = small_evaluation();
  report.tolerances = {{0.02, 5}};
  report.rpe_unit = RpeUnit::metres;
  const auto json = nlohmann::json::parse(format_evaluation_json(report));
  EXPECT_EQ(json["estimate"], "out/run/trajectory.txt");
  EXPECT_EQ(json["status"], "ok");
  EXPECT_EQ(json["alignment"], "se3");
  EXPECT_EQ(json["ate_rmse_m"], 0.0275);
  EXPECT_EQ(json["ate_max_deg"], 4.0);
  EXPECT_EQ(json["translation_m"], (std::vector<double>{3, 4, 0}));
  EXPECT_EQ(json["ate_percentiles"][0]["percent"], 50.0);
  EXPECT_EQ(json["ate_percentiles"][0]["deg"], 2.5);
  EXPECT_EQ(json["within"][0]["count"], 2);
  EXPECT_EQ(json["within"][0]["share_of_reference"], 0.4);
  EXPECT_TRUE(json["within"][0]["share_of_queries"].is_null());
  EXPECT_EQ(json["rpe_unit"], "metres");
  EXPECT_EQ(json["rpe_delta"], 2.5);
  EXPECT_TRUE(json["rpe_rmse_m"].is_null());
  EXPECT_EQ(json["rpe"][0]["unit"], "frames");
  EXPECT_EQ(json["rpe"][0]["rmse_deg"], 5.0);
  EXPECT_EQ(json["rpe"][0]["intervals"], 3);
  EXPECT_EQ(json["sim3"]["scale"], 1.0625);
  EXPECT_EQ(json["sim3"]["turn_uncertainty_deg"], 0.25 * (180.0 / std::numbers::pi));
  EXPECT_TRUE(json["drift"].is_null());
}

TEST(EvaluationJson, tells_why_there_are_no_figures) {
  EvaluationReport report = two_evaluations();
  report.estimates[0].result.status = EvaluationStatus::not_alignable;
  report.estimates[0].result.absolute.status = AlignmentStatus::one_line;
  const auto json = nlohmann::json::parse(format_evaluation_json(report));
  ASSERT_EQ(json["estimates"].size(), 2U);
  EXPECT_EQ(json["estimates"][0]["status"], "not_alignable");
  EXPECT_EQ(json["estimates"][0]["alignment_status"], "one_line");
  EXPECT_FALSE(json["estimates"][0].contains("ate_rmse_m"));
  EXPECT_EQ(json["estimates"][1]["status"], "no_pairs");
  EXPECT_FALSE(json["estimates"][1].contains("alignment_status"));
}

TEST(EvaluationPlot, names_what_it_shows) {
  const std::string one = draw_evaluation(small_evaluation());
  EXPECT_NE(one.find("ATE 2.75 cm rmse, 4 poses"), std::string::npos);
  EXPECT_NE(one.find("run/trajectory.txt against room/groundtruth.txt, aligned by se3"), std::string::npos);
  EvaluationReport report = two_evaluations();
  report.estimates.push_back(report.estimates[0]);
  const std::string two = draw_evaluation(report);  // the one without pairs is left out
  EXPECT_NE(two.find("2 estimates against room/groundtruth.txt"), std::string::npos);
  EXPECT_NE(two.find("jectory.txt 2.75 cm<"), std::string::npos);
  EXPECT_EQ(two.find("other.txt"), std::string::npos);
}

TEST(EvaluationPlot, needs_an_estimate_that_was_aligned) {
  EvaluationReport report = small_evaluation();
  report.estimates[0].result.status = EvaluationStatus::no_pairs;
  EXPECT_THROW((void)draw_evaluation(report), PreconditionError);
}

}  // namespace
}  // namespace cairn
