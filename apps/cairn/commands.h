// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace cairn::app {

/// Each subcommand: parse, fill an options struct, call one library function, print the result.
/// Returns the exit code: 0 done, 1 ran but found no answer, 2 usage. InputError is caught in main.
int run_simulate(int argc, char** argv);
int run_info(int argc, char** argv);
int run_rectify(int argc, char** argv);
int run_calibrate(int argc, char** argv);
int run_slam(int argc, char** argv);
int run_map(int argc, char** argv);
int run_localize(int argc, char** argv);
int run_cloud(int argc, char** argv);
int run_octree(int argc, char** argv);
int run_graph(int argc, char** argv);
int run_features(int argc, char** argv);
int run_match(int argc, char** argv);
int run_evaluate(int argc, char** argv);
int run_align(int argc, char** argv);
int run_two_view(int argc, char** argv);
int run_pnp(int argc, char** argv);

}  // namespace cairn::app
