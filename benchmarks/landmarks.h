// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "comparison.h"

namespace cairn::bench {

/// Landmarks, each on its own with its poses fixed, beside ceres::Solver and ceres::TinySolver.
void add_landmarks(Comparisons& comparisons);

}  // namespace cairn::bench
