// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "cairn/core/parameter.h"
#include "cairn/features/extractor.h"
#include "cairn/geometry/disparity_noise.h"
#include "cairn/map/observed_frame.h"
#include "cairn/sequence/sequence.h"

namespace cairn {

/// Describes the noise of depth images, as that of disparities fx baseline / z.
struct DepthNoise {
  double baseline = 0.075;  ///< virtual baseline, metres; that of the Kinect
  DisparityNoise stated;    ///< its sigma_px is 0 if the noise is to be estimated from the recording
  double min_depth = 0.2;   ///< smallest depth, metres; nearer is noise
  /// Distance of a feature from a jump of the depth below which it has no depth, pixels at the finest scale.
  double jump_radius = 3.0;
  double jump_sigmas = 8.0;  ///< change of disparity that is a jump, standard deviations
  double max_depth = 8.0;    ///< largest depth, metres; farther is noise

  [[nodiscard]] bool is_estimated() const { return stated.sigma_px == 0; }
  /// Returns the noise that is stated, or a cautious one, ten times a Kinect's, until it is estimated.
  [[nodiscard]] DisparityNoise at_start() const {
    return is_estimated() ? DisparityNoise{10 * kKinectNoise.sigma_px, 0} : stated;
  }
};

/// Describes how the left-right matches of a stereo sequence become disparities.
struct StereoNoise {
  double min_depth = 0.5;  ///< smallest depth, metres: gives, with the baseline, the largest disparity
  /// Smallest correlation of the windows in both images; with less, they show another thing or one of them is
  /// hidden.
  double min_correlation = 0.85;
  /// Search the right image itself for left features without a match, see StereoMatchOptions.
  bool search_images = false;
  /// Smallest disparity, in its standard deviations; a smaller one says nothing of the depth.
  double min_disparity_sigmas = 4.0;
  /// Part of every disparity's standard deviation that does not depend on the match, pixels: the pair's
  /// calibration sways with the mount, and moves all disparities of an image alike, which many features do
  /// not average out.
  double sigma_floor_px = 0.5;
  /// What is done about errors of the pair's calibration that the images show: "auto" corrects them where
  /// that matters, "report" only states them, "off" does not look.
  std::string self_calibration = "auto";
};

/// Holds the options of observing frames.
struct ObserverOptions {
  FeatureOptions features;
  DepthNoise depth_noise;
  StereoNoise stereo_noise;

  /// Throws InputError naming the parameter that is out of range.
  void validate() const;
};

/// Visits the parameters of features, depth noise (depth.*) and stereo noise (stereo.*).
void visit(ObserverOptions& options, ParameterVisitor& visitor);

/// Returns the rig that observations are of: a stereo sequence's own, or the undistorted RGB-D camera with
/// the virtual baseline of the depth noise.
[[nodiscard]] Rig rig_of(const Calibration& calibration, const DepthNoise& noise);

/// Reduces the images of a frame to features and observations (u, v, d) of the rig: pixels undistorted; depth
/// read at the nearest pixel, or the disparity of the matching feature in the right image. Features that
/// cannot be undistorted are left out; those without depth stay, without disparity and point. Keypoints are
/// undistorted as well.
class Observer {
 public:
  Observer(const Calibration& calibration, const ObserverOptions& options);
  /// Observes a stereo frame if it has a right image, else an RGB-D frame.
  [[nodiscard]] ObservedFrame observe(const Frame& frame) const;

 private:
  [[nodiscard]] ObservedFrame observe_rgbd(const Frame& frame) const;
  [[nodiscard]] ObservedFrame observe_stereo(const Frame& frame) const;

  Camera camera_;
  Rig rig_;
  DepthNoise depth_;
  StereoNoise stereo_;
  StereoCorrection correction_;
  std::unique_ptr<Extractor> extractor_;
};

}  // namespace cairn
