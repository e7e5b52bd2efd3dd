// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/alignment_plot.h"

#include <gtest/gtest.h>

#include <cmath>

namespace cairn {
namespace {

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// A circle in the plane without `normal`, five metres off before and a little after.
AlignmentPlot circle(int normal) {
  AlignmentPlot plot{"title", "subtitle", "before: 5 m", "after: 1 cm", {}, {}, {}};
  for (int i = 0; i <= 60; ++i) {
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    place[(normal + 1) % 3] = 2 * std::cos(0.1 * i);
    place[(normal + 2) % 3] = 2 * std::sin(0.1 * i);
    plot.reference.push_back(place);
    plot.estimate_before.emplace_back(place + Eigen::Vector3d(3, 4, 0));
    plot.estimate_after.emplace_back(1.01 * place);
  }
  return plot;
}

TEST(AlignmentPlot, LooksAlongTheSmallestSpread) {
  EXPECT_TRUE(contains(draw_alignment_plot(circle(2)), ">x in metres<"));
  EXPECT_TRUE(contains(draw_alignment_plot(circle(2)), ">y in metres<"));
  EXPECT_TRUE(contains(draw_alignment_plot(circle(1)), ">z in metres<"));
  EXPECT_FALSE(contains(draw_alignment_plot(circle(1)), ">y in metres<"));
  EXPECT_FALSE(contains(draw_alignment_plot(circle(0)), ">x in metres<"));
}

TEST(AlignmentPlot, NamesWhatIsShown) {
  const std::string svg = draw_alignment_plot(circle(2));
  for (const char* part :
       {">title<", ">subtitle<", ">before: 5 m<", ">after: 1 cm<", ">reference<", ">estimate<"})
    EXPECT_TRUE(contains(svg, part)) << part;
}

TEST(AlignmentPlot, IsFiniteForOnePlaceAndForNothing) {
  for (const AlignmentPlot& plot :
       {AlignmentPlot{}, AlignmentPlot{"", "", "", "", {{1, 2, 3}}, {{1, 2, 3}}, {{1, 2, 3}}}}) {
    EXPECT_FALSE(contains(draw_alignment_plot(plot), "nan"));
    EXPECT_FALSE(contains(draw_alignment_plot(plot), "inf"));
  }
}

}  // namespace
}  // namespace cairn
