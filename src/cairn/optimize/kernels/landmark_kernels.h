// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cairn/simd/dispatch.h"

namespace cairn {

constexpr int kObservationLanes = 8;  ///< observations side by side: the widest vector of doubles

/// Holds eight observations of one landmark; lane i of every array belongs to the i-th. With R the rotation
/// camera_from_world, c the camera's centre, q = X - c, and s, t the inverse standard deviations of pixels
/// and disparity, the errors of the point X in standard deviations are
///
///     (u . q) / (axis . q),   u = s (fx R_0 - (seen u - cx) R_2)
///     (v . q) / (axis . q),   v = s (fy R_1 - (seen v - cy) R_2)
///     disparity_scale / (axis . q) - disparity,   with axis = R_2, t fx baseline and t times the seen one.
///
/// A lane without an observation has the axis and centre of another one, and zeros.
struct alignas(64) ObservationBlock {
  double u[3][kObservationLanes];
  double v[3][kObservationLanes];
  double axis[3][kObservationLanes];
  double centre[3][kObservationLanes];
  double disparity_scale[kObservationLanes];
  double disparity[kObservationLanes];
};

/// Sums half the cost over the observations to second order in the point. Matrices are xx, xy, xz, yy, yz,
/// zz.
struct LandmarkSums {
  double information[6];  ///< J^T J
  /// J^T J plus this is the Hessian: second derivatives of the errors, times the errors.
  double curvature[6];
  double gradient[3];  ///< J^T e
  double squared_error;
};

/// Computes a landmark's equations at `point`: `expand` those of the errors e; `linearise` those of equations
/// linear in the point, the errors times depth over the depth of `point` (Hartley and Sturm 1997, sec. 5.2).
/// Both have the same values at `point`. pixel_errors and errors receive each lane's squared error, of (u, v)
/// and in total, in variances. An observation less than a micrometre in front of its camera has infinite
/// squared errors; the derivatives are then meaningless.
using LandmarkExpansion = void(const ObservationBlock* blocks, int count, const double* point,
                               LandmarkSums* sums, double* pixel_errors, double* errors);

/// Lists the kernels of one instruction set.
struct LandmarkKernels {
  LandmarkExpansion* expand;
  LandmarkExpansion* linearise;
};

CAIRN_KERNEL_TABLES(LandmarkKernels, kLandmarkKernels)

/// Returns the kernels for `set`, which must be available.
[[nodiscard]] inline const LandmarkKernels& landmark_kernels(InstructionSet set = default_instruction_set()) {
  return CAIRN_CHOOSE_KERNELS(set, kLandmarkKernels);
}

}  // namespace cairn
