// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "cairn/features/sift_extrema.h"

namespace cairn {

constexpr std::size_t kSiftDescriptorBytes = 128;
/// Width of one of the 4x4 cells (Lowe's program; section 6.1 has 4 px).
constexpr double kSiftCellSigmas = 3;

/// Computes SIFT's 128 bytes (Lowe 2004, section 6.1): 4x4 cells, row by row, of 8 directions each, in a
/// frame rotated by `angle_deg`. Gradients are taken on a grid of that frame, where all weights are
/// constants, instead of at the image's pixels. `root`: RootSIFT, whose Euclidean distance is the Hellinger
/// distance of the histograms (Arandjelovic and Zisserman, "Three things everyone should know to improve
/// object retrieval", CVPR 2012).
void describe_sift(const ScaleSpace& space, const ScalePoint& point, float angle_deg, bool root,
                   std::uint8_t* descriptor);

}  // namespace cairn
