// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "comparison.h"
#include "image_pairs.h"

namespace cairn::bench {

/// What the benchmarks of room `features` work on.
struct Inputs {
  GrayImage vga;   ///< 640x480
  GrayImage wide;  ///< 1242x375
  std::vector<ImagePair> pairs;
  StereoPair stereo;  ///< 1242x375
};

[[nodiscard]] Inputs load_inputs(const std::filesystem::path& data);

/// Each adds its rows; the inputs must live as long as the comparisons.
void add_orb(Comparisons& comparisons, const Inputs& inputs);
void add_matching(Comparisons& comparisons, const Inputs& inputs);
void add_places(Comparisons& comparisons, const Inputs& inputs);
void add_sift(Comparisons& comparisons, const Inputs& inputs);

}  // namespace cairn::bench
