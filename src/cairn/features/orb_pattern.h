// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cairn/features/kernels/orb_kernels.h"

namespace cairn {

/// Returns the 256 pairs of ORB (Rublee, Rabaud, Konolige and Bradski, ICCV 2011, section 4.3: learned to be
/// uncorrelated and spread evenly), so that descriptors are comparable with those of other implementations;
/// within 13 pixels of the centre along each axis.
[[nodiscard]] const BriefPattern& orb_pattern();

constexpr int kPatternReach = 18;  ///< pixels: the farthest rounded position of a rotated pattern

}  // namespace cairn
