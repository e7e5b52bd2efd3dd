// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "comparison.h"

namespace cairn::bench {

/// Maps on disk: opening one, finding images in it.
void add_map_queries(Comparisons& comparisons);
/// Trajectories compared with the truth.
void add_evaluation(Comparisons& comparisons);

}  // namespace cairn::bench
