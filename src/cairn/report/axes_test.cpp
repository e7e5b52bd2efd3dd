// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/axes.h"

#include <gtest/gtest.h>

namespace cairn {
namespace {

TEST(Axes, MapValuesToPixels) {
  const Axes axes{{10, 20}, {200, 100}, {-1, 0}, {1, 5}};
  EXPECT_EQ(axes({-1, 0}), Eigen::Vector2d(10, 120));
  EXPECT_EQ(axes({1, 5}), Eigen::Vector2d(210, 20));
  EXPECT_EQ(axes({0, 2.5}), Eigen::Vector2d(110, 70));
}

TEST(Axes, StepInRoundNumbers) {
  EXPECT_DOUBLE_EQ(nice_step(10, 10), 1);
  EXPECT_DOUBLE_EQ(nice_step(10, 9), 2);
  EXPECT_DOUBLE_EQ(nice_step(0.3, 10), 0.05);
  EXPECT_DOUBLE_EQ(nice_step(7000, 10), 1000);
  EXPECT_EQ(decimals_of(0.05), 2);
  EXPECT_EQ(decimals_of(0.1), 1);
  EXPECT_EQ(decimals_of(20), 0);
}

TEST(Axes, TickFromEdgeToEdge) {
  EXPECT_EQ(ticks(0, 1, 0.5), (std::vector<double>{0, 0.5, 1}));
  EXPECT_EQ(ticks(-0.1, 0.9, 0.5), (std::vector<double>{0, 0.5}));
  EXPECT_EQ(ticks(0, 0.3, 0.1).size(), 4U);  // 3 * 0.1 is above 0.3 by rounding
  EXPECT_TRUE(ticks(0.1, 0.4, 0.5).empty());
}

TEST(Axes, LeaveOutTheNumbersOfANeighbour) {
  const Axes axes{{10, 20}, {200, 100}, {0, 0}, {1, 5}};
  SvgCanvas both(300, 200), one(300, 200);
  draw_axes(axes, {"x", "y", true, true, {0.2, 5}}, both);
  draw_axes(axes, {"", "y", false, true, {0.2, 5}}, one);
  EXPECT_NE(both.finish().find(">0.2<"), std::string::npos);
  EXPECT_NE(both.finish().find(">x<"), std::string::npos);
  EXPECT_EQ(one.finish().find(">0.2<"), std::string::npos);
  EXPECT_EQ(one.finish().find(">x<"), std::string::npos);
  EXPECT_NE(one.finish().find(">5<"), std::string::npos);
}

}  // namespace
}  // namespace cairn
