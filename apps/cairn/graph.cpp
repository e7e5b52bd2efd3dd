// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "cairn/core/file.h"
#include "cairn/map_files/g2o_file.h"
#include "cairn/optimize/pose_graph_optimizer.h"
#include "cairn/report/graph_report.h"
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
  app.add_option("input", arguments.input, "pose graph in 3D or 2D, g2o text format")
      .type_name("IN.g2o")
      .required();
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

}  // namespace

int run_graph(int argc, char** argv) {
  GraphArguments arguments;
  CommandLine app("Moves the poses of a graph to where its edges' measurements fit best.", "graph");
  declare(app, arguments);
  if (const auto code = app.parse(argc, argv)) return *code;
  arguments.options.kernel = kKernels.at(arguments.robust);
  arguments.options.start = kStarts.at(arguments.start);

  std::vector<std::string> warnings;
  PoseGraph graph = read_g2o(arguments.input, &warnings);
  AtomicFile output(arguments.output);  // before the work: a path that cannot be written is known at once
  if (arguments.options.kernel != RobustKernel::none) flag_loop_edges_robust(graph);
  const auto progress = make_progress(arguments.common);
  for (const std::string& warning : warnings) progress->warn(warning);
  const PoseGraphReport report = optimize_pose_graph(graph, arguments.options, progress.get());
  output.write(format_g2o(graph));
  output.commit();
  const GraphSummary summary{arguments.output, arguments.robust};
  fmt::print("{}", arguments.common.json ? format_graph_json(graph, report, summary)
                                         : format_graph_text(graph, report, summary));
  if (!report.converged)
    progress->warn(fmt::format("{}: not converged. {}", arguments.input, report.termination));
  return report.converged ? 0 : 1;
}

}  // namespace cairn::app
