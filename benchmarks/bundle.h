// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "comparison.h"

namespace cairn::bench {

/// Adds the rows of bundle adjustment against Ceres: time to the same tolerance, and the cost reached.
void add_bundle(Comparisons& comparisons);

}  // namespace cairn::bench
