// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include "cairn/core/error.h"
#include "cairn/core/suggestion.h"
#include "commands.h"

namespace {

struct Command {
  std::string_view name;
  std::string_view summary;
  int (*run)(int, char**);
};

constexpr Command kCommands[] = {
    {"simulate", "make an RGB-D (room) or stereo (street) sequence with exact truth",
     cairn::app::run_simulate},
    {"info", "say what a sequence or a map is: format, frames, cameras, truth", cairn::app::run_info},
    {"rectify", "the rectified pairs of a stereo sequence, in KITTI layout", cairn::app::run_rectify},
    {"calibrate", "find what is wrong with the calibration of a recording", cairn::app::run_calibrate},
    {"slam", "RGB-D or stereo sequence to trajectory and map, coloured cloud and octree",
     cairn::app::run_slam},
    {"map", "stereo or RGB-D sequence with its poses to a map of landmarks", cairn::app::run_map},
    {"localize", "poses of images in a map, with their uncertainty and whether to trust them",
     cairn::app::run_localize},
    {"cloud", "coloured cloud (.ply, .pcd) from a sequence and its poses", cairn::app::run_cloud},
    {"octree", "occupancy octree (.bt, .ot) from a cloud, or from a sequence and its poses",
     cairn::app::run_octree},
    {"graph", "optimise a pose graph (.g2o)", cairn::app::run_graph},
    {"features", "find and describe features of images: counts, times, pictures", cairn::app::run_features},
    {"match", "find the features of one image in another", cairn::app::run_match},
    {"two-view", "motion between two images and the points that both see", cairn::app::run_two_view},
    {"pnp", "pose of a camera from points and their pixels", cairn::app::run_pnp},
    {"evaluate", "compare trajectories with their truth: ATE, RPE, drift", cairn::app::run_evaluate},
    {"align", "the transform that moves a trajectory onto another", cairn::app::run_align},
};

void print_usage(std::FILE* stream) {
  fmt::print(stream,
             "cairn builds visual maps and finds cameras in them.\n\nusage: cairn COMMAND [ARGUMENTS]\n\n");
  for (const auto& command : kCommands) fmt::print(stream, "  {:<10} {}\n", command.name, command.summary);
  fmt::print(stream,
             "\n  cairn COMMAND --help   options and an example\n  cairn --version\n\n"
             "exit codes: 0 done, 1 ran but found no answer, 2 bad input or usage\n");
}

int unknown_command(std::string_view name) {
  std::vector<std::string> names;
  for (const auto& command : kCommands) names.emplace_back(command.name);
  fmt::print(stderr, "cairn: '{}' is no command. {}\n", name,
             cairn::suggestion(name, names, "'cairn --help' lists them all."));
  return 2;
}

int dispatch(int argc, char** argv) {
  if (argc < 2) {
    print_usage(stderr);
    return 2;
  }
  const std::string_view name = argv[1];
  if (name == "--help" || name == "-h" || name == "help") {
    print_usage(stdout);
    return 0;
  }
  if (name == "--version") {
    fmt::print("cairn {}\n", CAIRN_VERSION);
    return 0;
  }
  const auto* command = std::find_if(std::begin(kCommands), std::end(kCommands),
                                     [&](const Command& c) { return c.name == name; });
  if (command == std::end(kCommands)) return unknown_command(name);
  return command->run(argc - 1, argv + 1);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return dispatch(argc, argv);
  } catch (const cairn::InputError& error) {
    fmt::print(stderr, "cairn: {}\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    fmt::print(stderr,
               "cairn: internal error: {}\n  This is a defect of cairn; please report it with the command "
               "that you ran.\n",
               error.what());
    return 3;
  }
}
