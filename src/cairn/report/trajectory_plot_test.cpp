// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/trajectory_plot.h"

#include <gtest/gtest.h>

#include <cmath>

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

/// A circle of 2 m in the plane without `normal`.
TrajectoryPlot circle(int normal) {
  TrajectoryPlot plot{"title & more", "subtitle", {}, {}};
  for (int i = 0; i <= 60; ++i) {
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    place[(normal + 1) % 3] = 2 * std::cos(0.1 * i);
    place[(normal + 2) % 3] = 2 * std::sin(0.1 * i);
    plot.reference.push_back(place);
    plot.estimate.push_back({1.01 * place, 0.001 * i, true});
  }
  return plot;
}

TEST(TrajectoryPlot, ShowsTheTwoAxesWithTheLargestSpread) {
  EXPECT_TRUE(contains(draw_trajectory_plot(circle(2)), ">x in metres<"));
  EXPECT_TRUE(contains(draw_trajectory_plot(circle(2)), ">y in metres<"));
  EXPECT_TRUE(contains(draw_trajectory_plot(circle(1)), ">z in metres<"));
  EXPECT_FALSE(contains(draw_trajectory_plot(circle(1)), ">y in metres<"));
  EXPECT_FALSE(contains(draw_trajectory_plot(circle(0)), ">x in metres<"));
}

TEST(TrajectoryPlot, NamesWhatIsShown) {
  const std::string svg = draw_trajectory_plot(circle(2));
  for (const char* part : {">title &amp; more<", ">subtitle<", ">reference<", ">estimate<", ">error, cm<"})
    EXPECT_TRUE(contains(svg, part)) << part;
}

TEST(TrajectoryPlot, LeavesGapsOpen) {
  TrajectoryPlot plot = circle(2);
  for (auto& pose : plot.estimate) pose.error_m = 0.01;
  EXPECT_EQ(count(draw_trajectory_plot(plot), "<polyline"), 2U);
  plot.estimate[30].connected = false;
  EXPECT_EQ(count(draw_trajectory_plot(plot), "<polyline"), 3U);
}

TEST(TrajectoryPlot, IsFiniteForOnePlaceAndForNothing) {
  const TrajectoryPlot one{"", "", {{1, 2, 3}}, {{{1, 2, 3}, 0.0, true}}};
  EXPECT_FALSE(contains(draw_trajectory_plot(one), "nan"));
  EXPECT_FALSE(contains(draw_trajectory_plot(one), "inf"));
  EXPECT_FALSE(contains(draw_trajectory_plot({}), "nan"));
}

}  // namespace
}  // namespace cairn
