// SPDX-License-Identifier: Apache-2.0
#include "cairn/slam/depth_noise_estimator.h"

#include "cairn/slam/window.h"

namespace cairn {

DepthNoiseEstimator::DepthNoiseEstimator(const Map& map, const DepthNoise& stated)
    : is_estimated_(stated.is_estimated()), result_{stated.at_start(), map.rig(), 0, is_estimated_} {
  if (!is_estimated_ || !map.header().depth_noise) return;
  result_.noise = *map.header().depth_noise;
  result_.is_assumed = false;
}

bool DepthNoiseEstimator::is_due(const Map& map) const {
  return is_estimated_ && map.keyframes().size() >= next_keyframes_;
}

std::optional<DisparityNoise> DepthNoiseEstimator::update(Map& map) {
  while (next_keyframes_ <= map.keyframes().size()) next_keyframes_ += (next_keyframes_ + 1) / 2;
  if (!is_estimated_) return std::nullopt;
  const Window window = whole_component(map, largest_component(map));
  const auto found = estimate_disparity_noise(window.problem);
  if (!found) return std::nullopt;
  result_ = *found;
  map.weigh_disparities(result_.noise);
  return result_.noise;
}

DisparityNoise DepthNoiseEstimator::finish(Map& map) {
  if (!update(map)) map.weigh_disparities(result_.noise);
  return result_.noise;
}

void DepthNoiseEstimator::weigh(ObservedFrame& frame) const {
  if (is_estimated_) weigh_disparities(result_.rig, result_.noise, frame);
}

}  // namespace cairn
