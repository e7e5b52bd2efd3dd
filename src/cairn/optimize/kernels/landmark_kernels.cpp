// SPDX-License-Identifier: Apache-2.0
#include "cairn/optimize/kernels/landmark_kernels.h"

#include "cairn/optimize/kernels/double_lanes.h"

namespace cairn::CAIRN_ISA {
namespace {

constexpr double kMinDepth = 1e-6;  // metres, as is_in_front has it
constexpr int kHessian = 6, kGradient = 3, kSums = kHessian + kGradient + 1;

struct Three {
  DoubleLanes x, y, z;
};

[[gnu::always_inline]] inline Three load_three(const double (*from)[kSightingLanes], int lane) {
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

/// What sightings add up to, lane by lane.
struct LaneSums {
  DoubleLanes sums[kSums];  // in the order of LandmarkSums
  DoubleLanes worst;
};

/// The three rows of J and e.
struct Rows {
  Three u, v, d;
  DoubleLanes eu, ev, ed;
};

[[gnu::always_inline]] inline void add(const Rows& rows, LaneSums& total) {
  const Three &u = rows.u, &v = rows.v, &d = rows.d;
  DoubleLanes* sums = total.sums;
  sums[0] = sums[0] + (u.x * u.x + v.x * v.x + d.x * d.x);
  sums[1] = sums[1] + (u.x * u.y + v.x * v.y + d.x * d.y);
  sums[2] = sums[2] + (u.x * u.z + v.x * v.z + d.x * d.z);
  sums[3] = sums[3] + (u.y * u.y + v.y * v.y + d.y * d.y);
  sums[4] = sums[4] + (u.y * u.z + v.y * v.z + d.y * d.z);
  sums[5] = sums[5] + (u.z * u.z + v.z * v.z + d.z * d.z);
  sums[6] = sums[6] + (rows.eu * u.x + rows.ev * v.x + rows.ed * d.x);
  sums[7] = sums[7] + (rows.eu * u.y + rows.ev * v.y + rows.ed * d.y);
  sums[8] = sums[8] + (rows.eu * u.z + rows.ev * v.z + rows.ed * d.z);
}

/// The derivative of (u . q) / z is (u - error axis) / z, that of scale / z is -scale / z^2 axis; of the
/// linear equations (u . q) / z_0 and (scale - disparity z) / z_0 it is u / z_0 and -disparity / z_0 axis.
template <bool linear>
[[gnu::always_inline]] inline void add_sightings(const SightingBlock& block, int lane, const Three& point,
                                                 LaneSums& total, double* pixel_errors, double* errors) {
  const Three u = load_three(block.u, lane), v = load_three(block.v, lane),
              axis = load_three(block.axis, lane);
  const Three q = minus(point, load_three(block.centre, lane));
  const DoubleLanes depth = dot(axis, q), inverse = spread(1.0) / depth;
  const DoubleLanes disparity = load(block.disparity + lane);
  const DoubleLanes projected = load(block.disparity_scale + lane) * inverse;
  Rows rows;
  rows.eu = dot(u, q) * inverse;
  rows.ev = dot(v, q) * inverse;
  rows.ed = projected - disparity;
  rows.u = times(inverse, linear ? u : minus(u, times(rows.eu, axis)));
  rows.v = times(inverse, linear ? v : minus(v, times(rows.ev, axis)));
  rows.d = times(spread(0.0) - (linear ? disparity : projected) * inverse, axis);
  add(rows, total);
  const DoubleLanes least = spread(kMinDepth), behind = spread(__builtin_inf());
  const DoubleLanes of_pixel = rows.eu * rows.eu + rows.ev * rows.ev;
  const DoubleLanes of_all = choose(depth, least, of_pixel + rows.ed * rows.ed, behind);
  total.sums[9] = total.sums[9] + of_all;
  total.worst = larger(of_all, total.worst);
  store(pixel_errors, choose(depth, least, of_pixel, behind));
  store(errors, of_all);
}

/// The eight lanes' sum, in one order for all widths.
[[gnu::always_inline]] inline double add_up(const double* lanes) {
  double four[4], two[2];
  for (int i = 0; i < 4; ++i) four[i] = lanes[i] + lanes[i + 4];
  for (int i = 0; i < 2; ++i) two[i] = four[i] + four[i + 2];
  return two[0] + two[1];
}

void add_up(const double (*lanes)[kSightingLanes], const double* worst, LandmarkSums* result) {
  for (int i = 0; i < kHessian; ++i) result->hessian[i] = add_up(lanes[i]);
  for (int i = 0; i < kGradient; ++i) result->gradient[i] = add_up(lanes[kHessian + i]);
  result->squared_error = add_up(lanes[kHessian + kGradient]);
  result->worst = 0.0;
  for (int i = 0; i < kSightingLanes; ++i)
    if (worst[i] > result->worst) result->worst = worst[i];
}

template <bool linear>
void sum_sightings(const SightingBlock* blocks, int count, const double* point, LandmarkSums* result,
                   double* pixel_errors, double* errors) {
  const Three at{spread(point[0]), spread(point[1]), spread(point[2])};
  alignas(64) double lanes[kSums][kSightingLanes], worst[kSightingLanes];
  for (int lane = 0; lane < kSightingLanes; lane += kDoubleLanes) {
    LaneSums total;
    for (DoubleLanes& sum : total.sums) sum = spread(0.0);
    total.worst = spread(0.0);
    for (int i = 0; i < count; ++i) {
      const int first = i * kSightingLanes + lane;
      add_sightings<linear>(blocks[i], lane, at, total, pixel_errors + first, errors + first);
    }
    for (int i = 0; i < kSums; ++i) store(lanes[i] + lane, total.sums[i]);
    store(worst + lane, total.worst);
  }
  add_up(lanes, worst, result);
}

}  // namespace

extern const LandmarkKernels kLandmarkKernels;
const LandmarkKernels kLandmarkKernels{sum_sightings<false>, sum_sightings<true>};

}  // namespace cairn::CAIRN_ISA
