// SPDX-License-Identifier: Apache-2.0
#include "cairn/optimize/kernels/landmark_kernels.h"

#include "cairn/simd/double_lanes.h"

namespace cairn::CAIRN_ISA {
namespace {

constexpr double kMinDepth = 1e-6;  // metres, as is_in_front has it
constexpr int kVectors = kObservationLanes / kDoubleLanes;

struct Three {
  DoubleLanes x, y, z;
};

[[gnu::always_inline]] inline Three load_three(const double (*from)[kObservationLanes], int lane) {
  return {load(from[0] + lane), load(from[1] + lane), load(from[2] + lane)};
}
[[gnu::always_inline]] inline Three minus(const Three& a, const Three& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
[[gnu::always_inline]] inline Three times(DoubleLanes factor, const Three& a) {
  return {factor * a.x, factor * a.y, factor * a.z};
}
[[gnu::always_inline]] inline DoubleLanes dot(const Three& a, const Three& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// The derivatives of the three errors of an observation, and the errors.
struct Rows {
  Three u, v, d;
  DoubleLanes eu, ev, ed;
};

/// LandmarkSums lane by lane, in its order from these places.
constexpr int kInformation = 0, kCurvature = 6, kGradient = 12, kSquaredError = 15, kSums = 16;
static_assert(sizeof(LandmarkSums) == kSums * sizeof(double));

struct LaneSums {
  DoubleLanes sums[kSums];
};

[[gnu::always_inline]] inline Three gradient_of(const Rows& rows) {
  const Three &u = rows.u, &v = rows.v, &d = rows.d;
  return {rows.eu * u.x + rows.ev * v.x + rows.ed * d.x, rows.eu * u.y + rows.ev * v.y + rows.ed * d.y,
          rows.eu * u.z + rows.ev * v.z + rows.ed * d.z};
}

[[gnu::always_inline]] inline void add_information(const Rows& rows, LaneSums& total) {
  const Three &u = rows.u, &v = rows.v, &d = rows.d;
  total.sums[kInformation] += u.x * u.x + v.x * v.x + d.x * d.x;
  total.sums[kInformation + 1] += u.x * u.y + v.x * v.y + d.x * d.y;
  total.sums[kInformation + 2] += u.x * u.z + v.x * v.z + d.x * d.z;
  total.sums[kInformation + 3] += u.y * u.y + v.y * v.y + d.y * d.y;
  total.sums[kInformation + 4] += u.y * u.z + v.y * v.z + d.y * d.z;
  total.sums[kInformation + 5] += u.z * u.z + v.z * v.z + d.z * d.z;
}

/// -(g a^T + a g^T) with g the observation's gradient and a = axis / depth. For each error is of the form
/// e = (m . q) / (axis . q) + constant, and so its second derivative is -(e' a^T + a e'^T), e' being its
/// first.
[[gnu::always_inline]] inline void add_curvature(const Three& g, const Three& a, LaneSums& total) {
  const Three b{broadcast(0.0) - a.x, broadcast(0.0) - a.y, broadcast(0.0) - a.z};
  total.sums[kCurvature] += g.x * b.x + g.x * b.x;
  total.sums[kCurvature + 1] += g.x * b.y + g.y * b.x;
  total.sums[kCurvature + 2] += g.x * b.z + g.z * b.x;
  total.sums[kCurvature + 3] += g.y * b.y + g.y * b.y;
  total.sums[kCurvature + 4] += g.y * b.z + g.z * b.y;
  total.sums[kCurvature + 5] += g.z * b.z + g.z * b.z;
}

/// The derivative of (u . q) / z is (u - error axis) / z, that of scale / z is -scale / z^2 axis; of the
/// linear equations (u . q) / z_0 and (scale - disparity z) / z_0 it is u / z_0 and -disparity / z_0 axis.
template <bool linear>
[[gnu::always_inline]] inline void add_observations(const ObservationBlock& block, int lane,
                                                    const Three& point, LaneSums& total, double* pixel_errors,
                                                    double* errors) {
  const Three u = load_three(block.u, lane), v = load_three(block.v, lane);
  const Three axis = load_three(block.axis, lane), q = minus(point, load_three(block.centre, lane));
  const DoubleLanes depth = dot(axis, q), inverse = broadcast(1.0) / depth;
  const DoubleLanes disparity = load(block.disparity + lane);
  const DoubleLanes projected = load(block.disparity_scale + lane) * inverse;
  Rows rows;
  rows.eu = dot(u, q) * inverse;
  rows.ev = dot(v, q) * inverse;
  rows.ed = projected - disparity;
  rows.u = times(inverse, linear ? u : minus(u, times(rows.eu, axis)));
  rows.v = times(inverse, linear ? v : minus(v, times(rows.ev, axis)));
  const Three by_depth = times(inverse, axis);
  rows.d = times(broadcast(0.0) - (linear ? disparity : projected), by_depth);
  add_information(rows, total);
  const Three gradient = gradient_of(rows);
  total.sums[kGradient] += gradient.x;
  total.sums[kGradient + 1] += gradient.y;
  total.sums[kGradient + 2] += gradient.z;
  if (!linear) add_curvature(gradient, by_depth, total);
  const DoubleLanes least = broadcast(kMinDepth), behind = broadcast(__builtin_inf());
  const DoubleLanes of_pixel = rows.eu * rows.eu + rows.ev * rows.ev;
  const DoubleLanes of_all = choose(depth, least, of_pixel + rows.ed * rows.ed, behind);
  total.sums[kSquaredError] += of_all;
  store(pixel_errors + lane, choose(depth, least, of_pixel, behind));
  store(errors + lane, of_all);
}

/// What the lanes from `lane` see.
template <bool linear>
[[gnu::always_inline]] inline LaneSums sum_lanes(const ObservationBlock* blocks, int count, int lane,
                                                 const Three& point, double* pixel_errors, double* errors) {
  LaneSums total;
  for (DoubleLanes& sum : total.sums) sum = broadcast(0.0);
  for (int i = 0; i < count; ++i)
    add_observations<linear>(blocks[i], lane, point, total, pixel_errors + i * kObservationLanes,
                             errors + i * kObservationLanes);
  return total;
}

template <bool linear>
void sum_observations(const ObservationBlock* blocks, int count, const double* point, LandmarkSums* sums,
                      double* pixel_errors, double* errors) {
  const Three at{broadcast(point[0]), broadcast(point[1]), broadcast(point[2])};
  DoubleLanes eights[kSums][kVectors];
  for (int i = 0; i < kVectors; ++i) {
    const LaneSums total = sum_lanes<linear>(blocks, count, i * kDoubleLanes, at, pixel_errors, errors);
    for (int sum = 0; sum < kSums; ++sum) eights[sum][i] = total.sums[sum];
  }
  double added[kSums];
  for (int sum = 0; sum < kSums; sum += 8) add_eights(eights + sum, added + sum);
  __builtin_memcpy(sums, added, sizeof added);
}

}  // namespace

extern const LandmarkKernels kLandmarkKernels;
const LandmarkKernels kLandmarkKernels{sum_observations<false>, sum_observations<true>};

}  // namespace cairn::CAIRN_ISA
