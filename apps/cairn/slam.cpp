// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <filesystem>

#include "cairn/core/file.h"
#include "cairn/slam/rgbd_slam.h"
#include "commands.h"
#include "common.h"

namespace cairn::app {

int run_slam(int argc, char** argv) {
  CLI::App app("RGB-D SLAM", "slam");
  CommonOptions common;
  SequenceArguments arguments;
  RgbdSlamOptions options;
  std::string output;
  app.add_option("SEQ", arguments.folder, "folder with a sequence")->required();
  app.add_option("-o,--output", output, "run folder")->required();
  app.add_option("--count", options.features.count);
  app.add_option("--detector", options.features.detector);
  app.add_option("--descriptor", options.features.descriptor);
  app.add_option("--kf", options.keyframe_threshold);
  app.add_option("--near", options.nearby_loops);
  app.add_option("--rand", options.random_loops);
  app.add_option("--sd", options.depth_noise.sigma_disparity_px);
  app.add_option("--maxd", options.depth_noise.max_depth);
  app.add_option("--jr", options.depth_noise.jump_radius);
  app.add_option("--js", options.depth_noise.jump_sigmas);
  app.add_flag("--odometry", options.odometry);
  add_sequence_options(app, arguments);
  add_common_options(app, common, {.config = true, .threads = true, .seed = true});
  if (const auto code = parse(app, argc, argv)) return *code;
  options.seed = common.seed;
  const Sequence sequence = open_sequence(arguments.folder, arguments.options());
  const Executor executor(common.thread_count());
  const auto progress = make_progress(common);
  OutputFolder folder(output);
  const RgbdSlamResult result = run_rgbd_slam(sequence, options, executor, *progress);
  write_file(folder.work() / "trajectory.txt", format_tum_trajectory(result.trajectory()));
  write_file(folder.work() / "keyframes.txt", format_tum_trajectory(result.keyframe_trajectory()));
  if (sequence.truth) write_file(folder.work() / "truth.txt", format_tum_trajectory(*sequence.truth));
  folder.commit();
  const auto tracked = result.trajectory().size();
  fmt::print("tracked {}/{} keyframes {} loops tried {} near {} far {} chi2 {} -> {}\n", tracked,
             result.frames.size(), result.map.keyframes.size(), result.loops.tried, result.loops.nearby,
             result.loops.far, result.graph_report.chi2_before, result.graph_report.chi2_after);
  const auto& s = result.seconds;
  fmt::print("decode {:.2f} features {:.2f} tracking {:.2f} loops {:.2f} graph {:.2f}\n", s.decode,
             s.features, s.tracking, s.loops, s.graph);
  double sum = 0;
  for (const auto& f : result.frames) sum += f.inliers;
  fmt::print("mean inliers {:.1f}\n", sum / double(result.frames.size()));
  return 0;
}

}  // namespace cairn::app
