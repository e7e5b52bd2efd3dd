// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/graph_report.h"

#include <gtest/gtest.h>

namespace cairn {
namespace {

struct GraphReport : testing::Test {
  GraphReport() {
    graph.vertices.resize(3);
    graph.edges.resize(2);
    report.chi2_before = 12.5;
    report.chi2_start = 6.25;
    report.chi2_after = 0.125;
    report.started_at = PoseGraphStart::chordal;
    report.iterations = 4;
    report.converged = true;
    report.termination = "small step";
    report.held = {0};
    report.components = 1;
    report.seconds = 0.25;
  }
  PoseGraph graph;
  PoseGraphReport report;
};

TEST_F(GraphReport, tells_chi_square_before_and_after) {
  EXPECT_EQ(format_graph_text(graph, report, {"out.g2o", "none"}),
            "vertices     3\nedges        2\nchi2 before  12.5\nchi2 start   6.25  (chordal relaxation)\n"
            "chi2 after   0.125\niterations   4, converged\nseconds      0.25\nwritten to   out.g2o\n");
}

TEST_F(GraphReport, tells_what_to_beware_of) {
  report.components = 2;
  report.converged = false;
  report.started_at = PoseGraphStart::given;
  const std::string text = format_graph_text(graph, report, {"out.g2o", "huber"});
  EXPECT_NE(text.find("components   2, not connected with each other\n"), std::string::npos);
  EXPECT_NE(text.find("chi2 start   6.25  (poses given)\n"), std::string::npos);
  EXPECT_NE(text.find("chi2 after   0.125  (without the robust kernel)\n"), std::string::npos);
  EXPECT_NE(text.find("iterations   4, NOT converged\n"), std::string::npos);
}

TEST_F(GraphReport, has_in_json_what_the_text_has) {
  EXPECT_EQ(format_graph_json(graph, report, {"out.g2o", "none"}), R"({
  "vertices": 3,
  "edges": 2,
  "components": 1,
  "held": [
    0
  ],
  "robust": "none",
  "started_at": "chordal",
  "chi2_before": 12.5,
  "chi2_start": 6.25,
  "chi2_after": 0.125,
  "iterations": 4,
  "converged": true,
  "termination": "small step",
  "seconds": 0.25,
  "output": "out.g2o"
}
)");
}

}  // namespace
}  // namespace cairn
