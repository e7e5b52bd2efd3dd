// SPDX-License-Identifier: Apache-2.0
#include "cairn/features/sift_descriptor.h"

#include <array>
#include <cmath>

#include "cairn/features/kernels/patch_kernels.h"
#include "cairn/features/sift_patch.h"

namespace cairn {
namespace {

constexpr int kCells = 4;
constexpr double kWindow =
    2;  // cells, half the descriptor's width: standard deviation of the weights (section 6.1)

/// A gradient's weight falls linearly to zero one cell away from a cell's centre, and with the Gaussian
/// window.
CellWeights make_weights() {
  CellWeights weights{};
  for (int cell = 0; cell < kCells; ++cell) {
    for (int k = 0; k < 2 * kCellSteps; ++k) {
      const double place = (cell * kCellSteps + k + 0.5) / kCellSteps - (kCells + 1) / 2.0;
      const double from_centre = place - (cell - (kCells - 1) / 2.0);
      weights.weights[cell][k] = static_cast<float>((1 - std::abs(from_centre)) *
                                                    std::exp(-place * place / (2 * kWindow * kWindow)));
    }
  }
  return weights;
}

}  // namespace

void describe_sift(const ScaleSpace& space, const ScalePoint& point, float angle_deg, bool root,
                   std::uint8_t* descriptor) {
  static const CellWeights kWeights = make_weights();
  std::array<float, kDescriptorSide * kDescriptorSide + kPatchSlack> samples{};
  sample_patch(
      space, point,
      {static_cast<double>(angle_deg), kSiftCellSigmas / kCellSteps, kDescriptorGradients, kDescriptorSide},
      samples.data());
  patch_kernels().describe(samples.data(), kWeights, root, descriptor);
}

}  // namespace cairn
