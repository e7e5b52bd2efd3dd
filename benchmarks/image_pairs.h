// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cairn/image/image.h"

namespace cairn::bench {

/// Two images of one static scene, and where a pixel of the first lies in the second, from depth and pose.
struct ImagePair {
  std::string group;  ///< recording and distance, "redkitchen, 10 apart"; figures are summed over a group
  GrayImage first, second;
  /// Nothing where the first image has no depth at that pixel, or the point is not in the second's view.
  std::function<std::optional<Eigen::Vector2d>(const Eigen::Vector2d&)> place_in_second;
};

/// A rectified pair with the left image's true depth.
struct StereoPair {
  GrayImage left, right;
  DepthImage depth;        ///< metres, 0 where there is none
  double fx_baseline = 0;  ///< disparity = fx_baseline / depth, pixels
};

/// The pairs that correct matches are counted on, from the recordings below `data`: two_view, redkitchen 10
/// and 30 frames apart, kitti_0039 one frame apart; where they are not there, of simulated scenes.
[[nodiscard]] std::vector<ImagePair> load_image_pairs(const std::filesystem::path& data);

/// A simulated street's pair, 1242x375.
[[nodiscard]] StereoPair simulate_stereo_pair();

}  // namespace cairn::bench
