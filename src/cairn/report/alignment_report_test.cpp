// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/alignment_report.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

namespace cairn {
namespace {

/// A quarter turn about z, then 1 2 3; of two pairs.
AlignmentReport quarter_turn() {
  AlignmentReport report;
  report.estimate_path = "runs/a/trajectory.txt";
  report.reference_path = "data/truth.txt";
  report.max_gap_s = 0.02;
  report.pairs.resize(2);
  report.pairs[1].estimate.translation = {1, 0, 0};
  report.alignment.status = AlignmentStatus::ok;
  report.alignment.target_from_source.rotation =
      Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitZ()));
  report.alignment.target_from_source.translation = {1, 2, 3};
  report.alignment.rmse = 0.125;
  report.rms_before_m = 4;
  return report;
}

TEST(AlignmentReport, tells_the_transform) {
  EXPECT_EQ(format_alignment_text(quarter_turn()),
            R"(pairs      2, stamps within 0.02 s
transform  reference = R * estimate + t, from the estimate's world to the reference's
R            0.000000000  -1.000000000   0.000000000
             1.000000000   0.000000000   0.000000000
             0.000000000   0.000000000   1.000000000
t            1.000000000   2.000000000   3.000000000  m
angle      90.000000 deg
residual   4.000000000 m RMS before, 0.125000000 m after
)");
}

TEST(AlignmentReport, tells_the_scale_only_if_it_was_looked_for) {
  AlignmentReport report = quarter_turn();
  report.with_scale = true;
  report.max_gap_s.reset();
  report.alignment.target_from_source.scale = 2.5;
  const std::string text = format_alignment_text(report);
  EXPECT_EQ(text.find("pairs      2\n"), 0U);
  EXPECT_NE(text.find("reference = s * R * estimate + t"), std::string::npos);
  EXPECT_NE(text.find("\ns            2.500000000\n"), std::string::npos);
}

TEST(AlignmentReport, tells_in_json_why_there_is_none) {
  AlignmentReport report;
  EXPECT_EQ(format_alignment_json(report), "{\n  \"status\": \"no_pairs\",\n  \"pairs\": 0\n}\n");
  report.pairs.resize(2);
  EXPECT_EQ(format_alignment_json(report), "{\n  \"status\": \"too_few_points\",\n  \"pairs\": 2\n}\n");
}

TEST(AlignmentReport, has_in_json_what_the_text_has) {
  AlignmentReport report = quarter_turn();
  report.alignment.target_from_source.rotation = Eigen::Quaterniond(0, 0, 0, 1);
  EXPECT_EQ(format_alignment_json(report), R"({
  "status": "ok",
  "pairs": 2,
  "direction": "reference_from_estimate",
  "rotation": [
    [
      -1.0,
      0.0,
      0.0
    ],
    [
      0.0,
      -1.0,
      0.0
    ],
    [
      0.0,
      0.0,
      1.0
    ]
  ],
  "scale": 1.0,
  "rotation_xyzw": [
    0.0,
    0.0,
    1.0,
    0.0
  ],
  "translation_m": [
    1.0,
    2.0,
    3.0
  ],
  "with_scale": false,
  "rms_before_m": 4.0,
  "rms_after_m": 0.125,
  "turn_uncertainty_deg": 0.0
}
)");
}

TEST(AlignmentReport, draws_both_sides) {
  const std::string svg = draw_alignment(quarter_turn());
  EXPECT_NE(svg.find("2 pairs aligned by se3"), std::string::npos);
  EXPECT_NE(svg.find("a/trajectory.txt onto data/truth.txt"), std::string::npos);
  EXPECT_NE(svg.find("before: 4 m RMS"), std::string::npos);
  EXPECT_NE(svg.find("after: 0.125 m RMS"), std::string::npos);
}

}  // namespace
}  // namespace cairn
