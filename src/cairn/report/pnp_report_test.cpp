// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/pnp_report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace cairn {
namespace {

/// Five of six points agree with a camera a metre behind the world's origin.
PnpReport found_pose() {
  PnpReport report;
  report.points = 6;
  report.used = 5;
  report.ransac = PnpResult{};
  report.ransac->status = RansacStatus::ok;
  report.ransac->inliers = {0, 1, 2, 3, 4};
  report.ransac->iterations = 40;
  report.ransac->log10_false_alarms = -12;
  report.fit.status = PoseStatus::ok;
  report.fit.camera_from_world.translation = {0, 0, 1};
  report.fit.covariance = 4e-6 * Matrix6d::Identity();
  report.fit.variance_factor = 1.25;
  report.fit.rms_px = 0.5;
  report.fit.cost = 0.625;
  report.fit.trace = {{2.5, 0, 0, true}, {0.625, 0.1, 0.001, true}, {0.75, 0.02, 0.0001, false}};
  report.judged = *report.ransac;
  return report;
}

TEST(PnpReport, tells_the_pose_and_how_sure_it_is) {
  const PnpReport report = found_pose();
  EXPECT_EQ(failure_of(report), "");
  EXPECT_EQ(format_pnp_text(report, {}),
            R"(ransac        5 of 6 points agree, 40 samples, 10^-12 false alarms expected
points        5 used of 6
iterations    )" +
                std::to_string(report.fit.iterations()) +
                R"(, ok
cost          0.625  half the sum of squares over sigma^2
residual      0.5 px RMS
world to       1.000000000  0.000000000  0.000000000    0.000000000
camera         0.000000000  1.000000000  0.000000000    0.000000000
               0.000000000  0.000000000  1.000000000    1.000000000
std rotation  0.115 0.115 0.115 deg, by the noise of pixels alone
std move      0.002 0.002 0.002 m, likewise: the points count as exact
variance      1.25 times what sigma 1 px says; multiply the stds by its root
)");
}

TEST(PnpReport, traces_the_cost_if_asked) {
  const std::string text = format_pnp_text(found_pose(), {.trace = true, .has_kernel = true});
  EXPECT_NE(text.find("iteration               cost         step    lambda\n"
                      "        0                2.5            0         0\n"
                      "        1              0.625          0.1     0.001\n"
                      "        2               0.75         0.02    0.0001  rejected\n"),
            std::string::npos);
  EXPECT_NE(text.find("half the sum of squares over sigma^2, with the kernel\n"), std::string::npos);
}

TEST(PnpReport, tells_how_many_points_agree_if_there_was_no_ransac) {
  PnpReport report = found_pose();
  report.ransac.reset();
  EXPECT_NE(format_pnp_text(report, {})
                .find("\nagreement     5 of 6 points in their pixels, within the 95 % limit of sigma\n"),
            std::string::npos);
}

TEST(PnpReport, has_no_pose_if_it_failed) {
  PnpReport report = found_pose();
  report.ransac->status = RansacStatus::by_chance;
  report.fit = {};
  EXPECT_EQ(failure_of(report), to_string(RansacStatus::by_chance));
  EXPECT_EQ(format_pnp_text(report, {}), "");
  const auto json = nlohmann::json::parse(format_pnp_json(report));
  EXPECT_EQ(json["status"], to_string(RansacStatus::by_chance));
  EXPECT_EQ(json["samples"], 40);
  EXPECT_FALSE(json.contains("camera_from_world"));
}

TEST(PnpReport, keeps_the_pose_if_steps_are_left) {
  PnpReport report = found_pose();
  report.fit.status = PoseStatus::not_converged;
  const auto json = nlohmann::json::parse(format_pnp_json(report));
  EXPECT_TRUE(json.contains("camera_from_world"));
  EXPECT_FALSE(json.contains("covariance"));
  report.fit.status = PoseStatus::behind_camera;
  EXPECT_FALSE(nlohmann::json::parse(format_pnp_json(report)).contains("camera_from_world"));
}

TEST(PnpReport, has_in_json_what_the_text_has) {
  const auto json = nlohmann::json::parse(format_pnp_json(found_pose()));
  EXPECT_EQ(json["status"], "ok");
  EXPECT_EQ(json["inliers"], (std::vector<int>{0, 1, 2, 3, 4}));
  EXPECT_EQ(json["trace"][1]["step"], 0.1);
  EXPECT_EQ(json["trace"][2]["accepted"], false);
  EXPECT_EQ(json["camera_from_world"][2], (std::vector<double>{0, 0, 1, 1}));
  EXPECT_EQ(json["covariance"][5][5], 4e-6);
  EXPECT_EQ(json["variance_factor"], 1.25);
}

}  // namespace
}  // namespace cairn
