// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "cairn/geometry/disparity_noise.h"
#include "cairn/optimize/bundle_adjustment.h"

namespace cairn {

/// Holds how sure the disparities of a bundle are.
struct DisparityNoiseEstimate {
  DisparityNoise noise;
  Rig rig;                       ///< that the disparities are of
  std::int64_t disparities = 0;  ///< disparities that it was estimated from; 0: it is stated or assumed
  bool is_assumed = false;       ///< neither estimated nor stated
};

/// Estimates the noise of the disparities of an adjusted problem from their residuals against the points,
/// which the other observations determine as well: variance components (Foerstner 1979) with the parts of
/// DisparityNoise, by an iteration that keeps them positive (Zhou, Hu, Zhou, Lange 2019, "MM algorithms for
/// variance components models"). A residual e has the variance r sigma^2, with the redundancy r from the
/// standard deviations that the observations state. Squares are cut off at 1.5 standard deviations, so that
/// wrong disparities count little (Huber 1964, proposal 2). Cameras are taken as exact, and observations
/// whose pixel does not fit do not count. Where points were adjusted with other standard deviations, as those
/// of a map that was weighed since, the estimate is nearer to these; the next one mends that. Returns nullopt
/// if fewer than 200 disparities have a redundancy.
[[nodiscard]] std::optional<DisparityNoiseEstimate> estimate_disparity_noise(const BundleProblem& problem);

/// Sets the standard deviations of a problem's disparities to those of `noise`.
void weigh_disparities(const DisparityNoise& noise, BundleProblem& problem);

}  // namespace cairn
