// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cstdio>
#include <nlohmann/json.hpp>

#include "cairn/core/file.h"
#include "cairn/map/g2o_file.h"
#include "cairn/optimize/pose_graph_optimizer.h"
#include "commands.h"
#include "common.h"
#include "named_values.h"

namespace cairn::app {
namespace {

const NamedValues<PoseGraphStart> kStarts = {
    {"given", PoseGraphStart::given}, {"chordal", PoseGraphStart::chordal}, {"best", PoseGraphStart::best}};

struct GraphArguments {
  CommonOptions common;
  std::string input, output, robust = "none", start = "best";
  PoseGraphOptions options;
};

void declare(CommandLine& app, GraphArguments& arguments) {
  app.add_option("input", arguments.input, "3D pose graph, g2o text format").type_name("IN.g2o").required();
  app.add_option("-o", arguments.output, "the optimised graph").type_name("OUT.g2o").required();
  app.add_option(
         "--robust", arguments.robust,
         "what wrong loop closures may cost: none, huber, cauchy or geman-mcclure, from weak to strong; "
         "for all edges but those from each vertex to the next")
      .check(one_of(names_of(kKernels)))
      .type_name("KERNEL")
      .show_default();
  app.add_option("--robust-scale", arguments.options.robust_scale,
                 "standard deviations of an edge at which --robust sets in")
      .check(number_in(1e-9, 1e9))
      .type_name("S")
      .show_default();
  app.add_option("--start", arguments.start,
                 "start at the poses given, at a chordal relaxation of the edges, or at the best of both")
      .check(one_of(names_of(kStarts)))
      .type_name("START")
      .show_default();
  app.add_option("--iterations", arguments.options.max_iterations, "at most so many steps")
      .check(number_in(1, 1'000'000))
      .type_name("N")
      .show_default();
  add_common_options(app, arguments.common, {});
  app.footer(
      "Example: cairn graph sphere2500.g2o -o optimised.g2o\nExit code 1: it did not converge; the best "
      "poses so far are written all the same.");
}

nlohmann::ordered_json to_json(const GraphArguments& arguments, const PoseGraph& graph,
                               const PoseGraphReport& report) {
  return {{"vertices", graph.vertices.size()},
          {"edges", graph.edges.size()},
          {"components", report.components},
          {"held", report.held},
          {"robust", arguments.robust},
          {"started_at", report.started_at == PoseGraphStart::chordal ? "chordal" : "given"},
          {"chi2_before", report.chi2_before},
          {"chi2_start", report.chi2_start},
          {"chi2_after", report.chi2_after},
          {"iterations", report.iterations},
          {"converged", report.converged},
          {"termination", report.termination},
          {"seconds", report.seconds},
          {"output", arguments.output}};
}

void print_report(const GraphArguments& arguments, const PoseGraph& graph, const PoseGraphReport& report) {
  const char* relaxed = report.started_at == PoseGraphStart::chordal ? "chordal relaxation" : "poses given";
  fmt::print("vertices     {}\nedges        {}\n", graph.vertices.size(), graph.edges.size());
  if (report.components > 1)
    fmt::print("components   {}, not connected with each other\n", report.components);
  fmt::print("chi2 before  {:.9g}\n", report.chi2_before);
  fmt::print("chi2 start   {:.9g}  ({})\n", report.chi2_start, relaxed);
  fmt::print("chi2 after   {:.9g}{}\n", report.chi2_after,
             arguments.robust == "none" ? "" : "  (without the robust kernel)");
  fmt::print("iterations   {}, {}\n", report.iterations, report.converged ? "converged" : "NOT converged");
  fmt::print("seconds      {:.2f}\nwritten to   {}\n", report.seconds, arguments.output);
}

}  // namespace

int run_graph(int argc, char** argv) {
  GraphArguments arguments;
  CommandLine app("Moves the poses of a graph to where its edges' measurements fit best.", "graph");
  declare(app, arguments);
  if (const auto code = app.parse(argc, argv)) return *code;
  arguments.options.kernel = kKernels.at(arguments.robust);
  arguments.options.start = kStarts.at(arguments.start);

  PoseGraph graph = read_g2o(arguments.input);
  AtomicFile output(arguments.output);  // before the work: a path that cannot be written is known at once
  if (arguments.options.kernel != RobustKernel::none) flag_loop_edges_robust(graph);
  const auto progress = make_progress(arguments.common);
  const PoseGraphReport report = optimize_pose_graph(graph, arguments.options, progress.get());
  output.write(format_g2o(graph));
  output.commit();
  if (arguments.common.json) {
    fmt::print("{}\n", to_json(arguments, graph, report).dump(2));
  } else {
    print_report(arguments, graph, report);
  }
  if (!report.converged)
    progress->warn(fmt::format("{}: not converged. {}", arguments.input, report.termination));
  return report.converged ? 0 : 1;
}

}  // namespace cairn::app
