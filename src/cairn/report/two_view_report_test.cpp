// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/two_view_report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <numbers>

namespace cairn {
namespace {

/// A camera that moved a unit to the right, and one point two units before it.
struct TwoViews : testing::Test {
  TwoViews()
      : a{"a.png", GrayImage(8, 6, 40), {}, 1}, b{"b.png", GrayImage(8, 6, 50), {}, 1}, report{a,  b, {},
                                                                                               {}, 1, 100,
                                                                                               {}, {}} {
    a.features.keypoints.resize(3);
    b.features.keypoints.resize(4);
    report.pixels_in_a = {{1, 2}, {3.5, 4}};
    report.pixels_in_b = {{0.5, 2}, {2.25, 4}};
    TwoViewResult& result = report.result;
    result.status = TwoViewStatus::ok;
    result.essential.status = RansacStatus::ok;
    result.essential.model << 0, 0, 0, 0, 0, 1, 0, -1, 0;
    result.essential.inliers = {0, 1};
    result.essential.iterations = 7;
    result.essential.log10_false_alarms = -3;
    result.homography.iterations = 9;
    result.choice.model = TwoViewModel::essential;
    result.motion = 1;
    result.motions[1].in_front = 2;
    result.b_from_a.translation = {-1, 0, 0};
    TwoViewPoint point;
    point.pair = 1;
    point.triangulated.point_in_a = {0.5, 0.25, 2};
    point.triangulated.angle = std::numbers::pi / 6;
    point.triangulated.squared_error = 0.0008;
    result.points = {point};
  }
  TimedFeatures a, b;
  TwoViewReport report;
};

TEST_F(TwoViews, are_told_in_text) {
  const std::string text = format_two_view_text(report);
  EXPECT_EQ(text.find("a.png  3 keypoints\nb.png  4 keypoints\n"
                      "matches          2, standard deviation of a pixel 1 px\n"
                      "essential        2 of 2 matches agree, 7 samples, 10^-3 false alarms expected\n"
                      "homography       none of 9 samples: "),
            0U);
  EXPECT_NE(text.find("R1, -t           2 of 0 matches in front of both cameras  <- most\n"),
            std::string::npos);
  EXPECT_NE(text.find("t                          -1            0            0\n"
                      "angle            0.0000 deg\npoints           1, 2 px RMS\n"),
            std::string::npos);
  EXPECT_EQ(text.find("scale "), std::string::npos);
}

TEST_F(TwoViews, end_with_the_counts_if_no_model_was_found) {
  report.result.essential.status = RansacStatus::degenerate;
  const std::string text = format_two_view_text(report);
  EXPECT_EQ(text.find("choice"), std::string::npos);
  EXPECT_FALSE(nlohmann::json::parse(format_two_view_json(report)).contains("motion"));
}

TEST_F(TwoViews, are_in_metres_if_the_scale_is_known) {
  report.scale = MetricScale{3, 0.5, 0.02};
  const std::string text = format_two_view_text(report);
  EXPECT_NE(text.find("point in B = R * point in A + t, t in metres\n"), std::string::npos);
  EXPECT_NE(
      text.find(
          "\nscale            0.5 m between the cameras, median over 3 points with depth, spread 2 %\n"),
      std::string::npos);
  const auto json = nlohmann::json::parse(format_two_view_json(report));
  EXPECT_EQ(json["motion"]["t"], (std::vector<double>{-0.5, 0, 0}));
  EXPECT_EQ(json["scale"]["metres"], 0.5);
}

TEST_F(TwoViews, are_told_in_json) {
  const auto json = nlohmann::json::parse(format_two_view_json(report));
  EXPECT_EQ(json["status"], "ok");
  EXPECT_EQ(json["keypoints"], (std::vector<int>{3, 4}));
  EXPECT_EQ(json["essential"]["matrix"][1], (std::vector<double>{0, 0, 1}));
  EXPECT_FALSE(json["homography"].contains("matrix"));
  EXPECT_EQ(json["decomposition"]["R1"].size(), 3U);
  EXPECT_EQ(json["motions"].size(), 4U);
  EXPECT_EQ(json["points"], 1);
  EXPECT_NEAR(json["rms_px"], 2, 1e-12);
}

TEST_F(TwoViews, list_their_points) {
  report.result.points[0].triangulated.angle = 0;
  EXPECT_EQ(format_points_csv(report), "u1,v1,u2,v2,x,y,z,angle_deg\n3.5,4,2.25,4,0.5,0.25,2,0\n");
}

TEST_F(TwoViews, give_a_cloud_in_the_greys_of_the_first_image) {
  a.image(4, 4) = 77;  // the nearest to 3.5 4
  const Cloud cloud = cloud_of(report);
  ASSERT_EQ(cloud.points.size(), 1U);
  EXPECT_EQ(cloud.points[0].x, 0.5F);
  EXPECT_EQ(cloud.points[0].z, 2.0F);
  EXPECT_EQ(cloud.points[0].r, 77);
}

TEST(Decomposition, is_that_of_the_nearest_essential_matrix) {
  Eigen::Matrix3d essential;
  essential << 0, 0, 0, 0, 0, -2, 0, 2, 0;  // t^R, R the identity, t two units along x
  const EssentialDecomposition parts = decompose_essential(essential);
  EXPECT_NEAR(relative_distance(essential, parts), 0, 1e-15);
  EXPECT_NEAR(relative_distance(essential + Eigen::Vector3d(1, 0, 0).asDiagonal().toDenseMatrix(), parts),
              1.0 / 3, 1e-12);
  const std::string text = format_decomposition_text(essential, parts);
  EXPECT_EQ(text.find("E                           0            0            0\n"
                      "                            0            0           -2\n"
                      "                            0            2            0\n"
                      "singular values             2            2            0\n"),
            0U);
  const auto json = nlohmann::json::parse(format_decomposition_json(essential, parts));
  EXPECT_EQ(json["essential"][2], (std::vector<double>{0, 2, 0}));
  EXPECT_NEAR(json["relative_distance"], 0, 1e-15);
}

}  // namespace
}  // namespace cairn
