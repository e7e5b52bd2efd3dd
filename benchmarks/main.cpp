// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <exception>

#include "bundle.h"
#include "comparison.h"
#include "features.h"
#include "geometry.h"
#include "landmarks.h"
#include "localization.h"

int main(int argc, char** argv) {
  try {
    const cairn::bench::Inputs inputs = cairn::bench::load_inputs(CAIRN_DATA_DIR);
    cairn::bench::Comparisons comparisons;
    cairn::bench::add_orb(comparisons, inputs);
    cairn::bench::add_matching(comparisons, inputs);
    cairn::bench::add_places(comparisons, inputs);
    cairn::bench::add_sift(comparisons, inputs);
    cairn::bench::add_geometry(comparisons);
    cairn::bench::add_bundle(comparisons);
    cairn::bench::add_landmarks(comparisons);
    cairn::bench::add_map_queries(comparisons);
    cairn::bench::add_evaluation(comparisons);
    return cairn::bench::run(comparisons, argc, argv) == 0 ? 0 : 1;
  } catch (const std::exception& error) {
    fmt::print(stderr, "cairn_bench: {}\n", error.what());
    return 2;
  }
}
