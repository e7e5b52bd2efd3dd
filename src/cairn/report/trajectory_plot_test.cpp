// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/trajectory_plot.h"

#include <gtest/gtest.h>

#include <cmath>

#include "cairn/report/colors.h"

namespace cairn {
namespace {

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

/// A circle of 2 m in the plane z = 0.
TrajectoryPlot circle(std::size_t estimates = 1) {
  TrajectoryPlot plot{"title & more", "subtitle", {}, {}};
  plot.estimates.resize(estimates);
  for (std::size_t k = 0; k < estimates; ++k) plot.estimates[k].name = "run" + std::to_string(k);
  for (int i = 0; i <= 60; ++i) {
    const Eigen::Vector3d place(2 * std::cos(0.1 * i), 2 * std::sin(0.1 * i), 0);
    plot.reference.push_back(place);
    for (auto& estimate : plot.estimates)
      estimate.poses.push_back({0.1 * i, 1.01 * place, 0.001 * i, 0.02 * i, true});
  }
  return plot;
}

TEST(TrajectoryPlot, ShowsThreeViewsAndTwoCharts) {
  const std::string svg = draw_trajectory_plot(circle());
  for (const char* part : {">x in metres<", ">y in metres<", ">z in metres<", ">time in seconds<",
                           ">error in cm<", ">error in deg<", ">error, cm<"})
    EXPECT_TRUE(contains(svg, part)) << part;
  EXPECT_EQ(count(svg, ">y in metres<"), 2U);  // of xy and of yz
}

TEST(TrajectoryPlot, NamesWhatIsShown) {
  const std::string one = draw_trajectory_plot(circle());
  for (const char* part : {">title &amp; more<", ">subtitle<", ">reference<", ">run0<", ">start<", ">end<"})
    EXPECT_TRUE(contains(one, part)) << part;
  const std::string three = draw_trajectory_plot(circle(3));
  for (const char* part : {">run0<", ">run1<", ">run2<"}) EXPECT_TRUE(contains(three, part)) << part;
  EXPECT_FALSE(contains(three, ">error, cm<"));  // colours tell the estimates apart there, not the errors
}

TEST(TrajectoryPlot, ShortensNamesThatDoNotFit) {
  TrajectoryPlot plot = circle();
  plot.estimates[0].name = std::string(100, 'a') + "/trajectory.txt";
  const std::string svg = draw_trajectory_plot(plot);
  EXPECT_TRUE(contains(svg, ">…"));
  EXPECT_TRUE(contains(svg, "/trajectory.txt<"));
}

TEST(TrajectoryPlot, ColorsByError) {
  TrajectoryPlot plot = circle();
  plot.estimates[0].poses[30].error_m = 1.0;
  const std::string svg = draw_trajectory_plot(plot);
  EXPECT_TRUE(contains(svg, error_color(0)));
  EXPECT_TRUE(contains(svg, error_color(1)));
  EXPECT_TRUE(contains(svg, ">error, m<"));
}

TEST(TrajectoryPlot, LeavesGapsOpen) {
  TrajectoryPlot plot = circle();
  for (auto& pose : plot.estimates[0].poses) pose.error_m = 0.01;
  EXPECT_EQ(count(draw_trajectory_plot(plot), "<polyline"), 3U * 2U + 2U);
  plot.estimates[0].poses[30].connected = false;
  EXPECT_EQ(count(draw_trajectory_plot(plot), "<polyline"), 3U * 3U + 4U);
}

TEST(TrajectoryPlot, IsFiniteForOnePlaceAndForNothing) {
  const TrajectoryPlot one{"", "", {{1, 2, 3}}, {{"a", {{5, {1, 2, 3}, 0.0, 0.0, true}}}}};
  for (const TrajectoryPlot& plot : {one, TrajectoryPlot{}, TrajectoryPlot{"", "", {}, {{"a", {}}}}}) {
    const std::string svg = draw_trajectory_plot(plot);
    EXPECT_FALSE(contains(svg, "nan"));
    EXPECT_FALSE(contains(svg, "inf"));
  }
}

}  // namespace
}  // namespace cairn
