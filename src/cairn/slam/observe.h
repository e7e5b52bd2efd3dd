// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "cairn/features/extractor.h"
#include "cairn/map/observed_frame.h"
#include "cairn/sequence/sequence.h"
#include "cairn/slam/options.h"

namespace cairn {

/// The rig that observations are made for: a stereo sequence's own, or the undistorted RGB-D camera with the
/// depth noise's virtual baseline.
[[nodiscard]] Rig rig_of(const Calibration& calibration, const DepthNoise& noise);

/// Features of a frame as observations (u, v, d) of the rig: pixels undistorted, depth read at the nearest
/// pixel, or the disparity of the right image's feature. Features that cannot be undistorted are left out;
/// those without depth stay, without disparity and point. Keypoints lie in the undistorted image, too.
class Observer {
 public:
  Observer(const Calibration& calibration, const SlamOptions& options);
  [[nodiscard]] ObservedFrame observe(const Frame& frame) const;

 private:
  [[nodiscard]] ObservedFrame observe_rgbd(const Frame& frame) const;
  [[nodiscard]] ObservedFrame observe_stereo(const Frame& frame) const;

  Camera camera_;
  Rig rig_;
  DepthNoise depth_;
  StereoNoise stereo_;
  std::unique_ptr<Extractor> extractor_;
};

}  // namespace cairn
