// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "cairn/core/executor.h"
#include "cairn/features/features.h"
#include "cairn/geometry/rig.h"
#include "cairn/image/image.h"

namespace cairn {

/// Sets which right feature a left one may match.
struct StereoMatchOptions {
  /// Minimum depth, metres, above 0: with the baseline, the largest disparity searched.
  double min_depth = 0.5;
  /// Maximum depth, metres: the smallest disparity.
  double max_depth = std::numeric_limits<double>::infinity();
  double row_band = 2;  ///< largest difference of the rows, in units of the larger sigma of both keypoints
  double max_size_ratio =
      1.5;  ///< maximum ratio of the keypoints' sizes: both show one patch from about the same distance
  double max_distance = std::numeric_limits<double>::infinity();  ///< of the descriptors, as Match::distance
  double max_ratio = 0;  ///< as MatchOptions::max_ratio, among the candidates within the other limits
  /// Of the windows, see MeasuredDisparity; below, they show different or hidden things.
  double min_correlation = 0.85;
  /// If true, a left feature without a right one is searched in the right image itself by its window, because
  /// detectors find only half of the features again. Such a match has no right feature.
  bool search_images = false;

  /// Throws PreconditionError if a limit is out of range.
  void validate() const;
};

/// Describes the match of a left feature.
struct StereoMatch {
  std::int32_t right = 0;         ///< index of the right feature; -1 if found in the image alone
  float distance = 0;             ///< of the descriptors; infinite if found in the image alone
  double disparity = 0;           ///< pixels, at the left keypoint; above 0 and within the depth limits
  double sigma_disparity_px = 0;  ///< standard deviation of the disparity
  /// True if the disparity was measured on the images; else it is the difference of the keypoints: at
  /// borders, or with too little texture.
  bool measured = false;
};

/// Refers to one image of a pair and its features.
struct StereoSide {
  const Features& features;
  const GrayImage& image;
};

/// Returns for each left feature its match in a rectified pair, or nullopt: the nearest right feature in a
/// band of rows and a range of disparities, which also has the left one as its nearest (ties go to the lower
/// index); then its disparity is measured on the images (stereo_disparity.h). No result holds a NaN; a
/// keypoint that is not finite or not in its image, or whose sigma is not above 0, matches nothing. Gives the
/// same bits at any number of threads and on every processor. Throws PreconditionError if an option is out of
/// range, the rig has no focal length or baseline, or the kinds of descriptor or the images' sizes differ.
[[nodiscard]] std::vector<std::optional<StereoMatch>> match_stereo(const Rig& rig, const StereoSide& left,
                                                                   const StereoSide& right,
                                                                   const StereoMatchOptions& options,
                                                                   const Executor& executor = Executor());

}  // namespace cairn
