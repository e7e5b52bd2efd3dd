// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/graph_report.h"

#include <nlohmann/json.hpp>

#include "cairn/report/json_pieces.h"
#include "cairn/report/text_builder.h"

namespace cairn {

std::string format_graph_text(const PoseGraph& graph, const PoseGraphReport& report,
                              const GraphSummary& summary) {
  TextBuilder text;
  const char* relaxed = report.started_at == PoseGraphStart::chordal ? "chordal relaxation" : "poses given";
  text.add("vertices     {}\nedges        {}\n", graph.vertices.size(), graph.edges.size());
  if (report.components > 1) text.add("components   {}, not connected with each other\n", report.components);
  text.add("chi2 before  {:.9g}\n", report.chi2_before);
  text.add("chi2 start   {:.9g}  ({})\n", report.chi2_start, relaxed);
  text.add("chi2 after   {:.9g}{}\n", report.chi2_after,
           summary.robust == "none" ? "" : "  (without the robust kernel)");
  text.add("iterations   {}, {}\n", report.iterations, report.converged ? "converged" : "NOT converged");
  text.add("seconds      {:.2f}\nwritten to   {}\n", report.seconds, summary.output);
  return text.take();
}

std::string format_graph_json(const PoseGraph& graph, const PoseGraphReport& report,
                              const GraphSummary& summary) {
  return format_document({{"vertices", graph.vertices.size()},
                          {"edges", graph.edges.size()},
                          {"components", report.components},
                          {"held", report.held},
                          {"robust", summary.robust},
                          {"started_at", report.started_at == PoseGraphStart::chordal ? "chordal" : "given"},
                          {"chi2_before", report.chi2_before},
                          {"chi2_start", report.chi2_start},
                          {"chi2_after", report.chi2_after},
                          {"iterations", report.iterations},
                          {"converged", report.converged},
                          {"termination", report.termination},
                          {"seconds", report.seconds},
                          {"output", summary.output}});
}

}  // namespace cairn
