// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/coverage_plot.h"

#include <gtest/gtest.h>

#include <string>

#include "cairn/core/error.h"
#include "cairn/evaluate/chi_square.h"

namespace cairn {
namespace {

/// NEES as honest as can be: the quantiles of the chi-square distribution, times `factor`.
ConsistencyReport even_report(double factor) {
  std::vector<double> nees;
  for (int i = 0; i < 100; ++i) nees.push_back(factor * chi_square_quantile((i + 0.5) / 100, 3));
  return assess_consistency(nees, 3).value();
}

std::size_t count_of(const std::string& text, const std::string& word) {
  std::size_t count = 0;
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++count;
  return count;
}

TEST(CoveragePlot, draws_a_curve_with_four_marks) {
  const std::string svg = draw_coverage_plot({"Title", "subtitle", {{"panel", {{"all", even_report(1)}}}}});
  EXPECT_EQ(svg.find("<svg"), 0U);
  for (const char* word : {">Title<", ">subtitle<", ">panel<", ">expected share, %<", ">observed share, %<"})
    EXPECT_NE(svg.find(word), std::string::npos) << word;
  EXPECT_NE(svg.find(">all: 100, NEES/dof 0.9"), std::string::npos);
  EXPECT_EQ(count_of(svg, "<circle"), 4U);
}

/// The middle of the axes is 84 + 175 = 259 pixels from the left, 116 + 175 = 291 from above.
TEST(CoveragePlot, puts_honest_covariances_on_the_diagonal) {
  EXPECT_NE(draw_coverage_plot({"", "", {{"", {{"", even_report(1)}}}}}).find("259.0,291.0"),
            std::string::npos);
  EXPECT_EQ(draw_coverage_plot({"", "", {{"", {{"", even_report(4)}}}}}).find("259.0,291.0"),
            std::string::npos);
}

TEST(CoveragePlot, has_rows_of_three_panels) {
  const CoveragePlot::Panel panel{"one of four", {{"a", even_report(1)}, {"b", even_report(2)}}};
  const std::string svg = draw_coverage_plot({"", "", {panel, panel, panel, panel}});
  EXPECT_EQ(count_of(svg, ">one of four<"), 4U);
  EXPECT_EQ(count_of(svg, "<circle"), 32U);
}

TEST(CoveragePlot, needs_something_to_draw) {
  EXPECT_THROW((void)draw_coverage_plot({}), PreconditionError);
  EXPECT_THROW((void)draw_coverage_plot({"", "", {{"", {}}}}), PreconditionError);
}

}  // namespace
}  // namespace cairn
