// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "comparison.h"

namespace cairn::bench {

/// Adds the rows of pose and essential matrix in RANSAC: time, and how often the result is right.
void add_geometry(Comparisons& comparisons);

}  // namespace cairn::bench
