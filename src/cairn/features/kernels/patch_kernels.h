// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "cairn/simd/dispatch.h"

namespace cairn {

/// Describes a square grid of points on an image: sample (i, j) lies at (x, y) + (j - middle) u + (i -
/// middle) v, with u = (ux, uy) and v = (-uy, ux), u rotated by 90 degrees. Beyond the border the image
/// repeats its border pixels.
struct PatchGrid {
  const float* pixels;  ///< an image of at least 2x2 pixels
  int width, height, stride;
  float x, y;    ///< middle of the grid, pixels
  float ux, uy;  ///< step from column to column, pixels
  float middle;  ///< row and column of the grid that lie at (x, y)
};

constexpr int kOrientationBins = 36;                  ///< as Lowe 2004, section 5
constexpr int kOrientationSide = 16;                  ///< samples; gradients lie between them, 15 by 15
constexpr int kCellSteps = 3;                         ///< gradients along a side of a descriptor's cell
constexpr int kDescriptorGradients = 5 * kCellSteps;  ///< 4 cells and half a cell on either side
constexpr int kDescriptorSide = (kDescriptorGradients + 16) / 16 * 16;
constexpr int kDescriptorBytes = 128;

/// Holds the weights of the gradients of one direction of the grid in the four cells: gradient cell *
/// kCellSteps + k has weights[cell][k] in `cell`, others none.
struct CellWeights {
  float weights[4][2 * kCellSteps];
};

/// Lists the kernels of one instruction set.
struct PatchKernels {
  /// Samples the grid's points bilinearly, row by row; `side` is a multiple of 16.
  void (*sample)(const PatchGrid& grid, int side, float* samples);
  /// Adds up the gradients between kOrientationSide^2 samples by direction, each times its weight:
  /// weights[16 i + j] for the gradient amid samples (i, j) and (i + 1, j + 1). Bin b holds directions around
  /// 2 pi b / 36, clockwise from the grid's columns.
  void (*orientations)(const float* samples, const float* weights, float* histogram);
  /// Computes the descriptor as bytes: 4x4 cells of 8 directions from kDescriptorSide^2 samples (and 16
  /// readable floats more), of length 512 after each value was limited to 0.2 of the whole. `root`: square
  /// roots of the values' shares.
  void (*describe)(const float* samples, const CellWeights& weights, bool root, std::uint8_t* descriptor);
};

CAIRN_KERNEL_TABLES(PatchKernels, kPatchKernels)

/// Returns the kernels for `set`, which must be available.
[[nodiscard]] inline const PatchKernels& patch_kernels(InstructionSet set = default_instruction_set()) {
  return CAIRN_CHOOSE_KERNELS(set, kPatchKernels);
}

}  // namespace cairn
