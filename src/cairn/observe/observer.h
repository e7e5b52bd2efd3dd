// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "cairn/core/parameter.h"
#include "cairn/features/extractor.h"
#include "cairn/map/observed_frame.h"
#include "cairn/sequence/sequence.h"

namespace cairn {

/// How noisy depth is. A structured-light or stereo sensor measures disparity, so the standard deviation of a
/// depth z is sigma_disparity_px * z^2 / (fx * baseline): with the defaults 2.3 mm at 1 m and 21 mm at 3 m,
/// twice what Khoshelham and Elberink 2012 measured for the Kinect, as features sit where depth is worst.
struct DepthNoise {
  double baseline = 0.075;           ///< metres, virtual; the Kinect's own
  double sigma_disparity_px = 0.09;  ///< pixels
  double min_depth = 0.2;            ///< metres; nearer is noise
  double jump_radius =
      3.0;  ///< pixels at the lowest pyramid level: depth must be smooth this far around a feature
  double jump_sigmas = 8.0;  ///< standard deviations of disparity: more is a jump
  double max_depth = 8.0;    ///< metres; farther is noise
};

/// How the left-right matches of a stereo sequence become disparities.
struct StereoNoise {
  double min_depth = 0.5;             ///< metres: with the baseline, the largest disparity looked for
  double min_correlation = 0.85;      ///< of the windows in both images; less is another thing or hidden
  bool search_images = false;         ///< see StereoMatchOptions
  double min_disparity_sigmas = 4.0;  ///< a disparity of fewer standard deviations says nothing of the depth
  /// No disparity is better, as the pair's calibration is not: it sways with the mount, and moves all
  /// disparities of an image alike, which many features do not average out.
  double sigma_floor_px = 0.5;
};

/// What becomes of a frame's images.
struct ObserverOptions {
  FeatureOptions features;
  DepthNoise depth_noise;
  StereoNoise stereo_noise;

  /// Throws InputError naming the parameter that is out of range.
  void validate() const;
};

/// Visits the parameters of features, depth noise (depth.*) and stereo noise (stereo.*).
void visit(ObserverOptions& options, ParameterVisitor& visitor);

/// The rig that observations are made for: a stereo sequence's own, or the undistorted RGB-D camera with the
/// depth noise's virtual baseline.
[[nodiscard]] Rig rig_of(const Calibration& calibration, const DepthNoise& noise);

/// Features of a frame as observations (u, v, d) of the rig: pixels undistorted, depth read at the nearest
/// pixel, or the disparity of the right image's feature. Features that cannot be undistorted are left out;
/// those without depth stay, without disparity and point. Keypoints lie in the undistorted image, too.
class Observer {
 public:
  Observer(const Calibration& calibration, const ObserverOptions& options);
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
