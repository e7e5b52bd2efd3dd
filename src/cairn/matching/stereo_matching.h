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

struct StereoMatchOptions {
  double min_depth = 0.5;  ///< metres, above 0: with the baseline, the largest disparity looked for
  double max_depth = std::numeric_limits<double>::infinity();  ///< metres: the smallest disparity
  double row_band = 2;          ///< largest difference of the rows, times the larger of both keypoints' sigma
  double max_size_ratio = 1.5;  ///< of the keypoints' sizes: they show one patch from one distance
  double max_distance = std::numeric_limits<double>::infinity();  ///< of the descriptors, as Match::distance
  double max_ratio = 0;           ///< as MatchOptions::max_ratio, among those within the limits above
  double min_correlation = 0.85;  ///< of the windows, see MeasuredDisparity; less is another thing or hidden
  /// A left feature that has no right one is looked for in the right image itself, by its window: detectors
  /// find half of the features again. Such a match has no right feature.
  bool search_images = false;

  /// PreconditionError for limits without meaning.
  void validate() const;
};

struct StereoMatch {
  std::int32_t right = 0;         ///< index of the right feature; -1: found in the image alone
  float distance = 0;             ///< of the descriptors
  double disparity = 0;           ///< pixels, at the left keypoint; above 0 and within the depth limits
  double sigma_disparity_px = 0;  ///< its standard deviation
  /// On the images; else the keypoints' difference: at borders, or with too little texture.
  bool measured = false;
};

struct StereoSide {
  const Features& features;
  const GrayImage& image;
};

/// For each left feature its right one in a rectified pair, or nothing: the nearest in a band of rows and a
/// range of disparities, which has the left one as its nearest, too (ties go to the lower index); then its
/// disparity is measured on the images (stereo_disparity.h). No result holds a NaN or an infinity; a keypoint
/// that is not finite or not in its image, or whose sigma is not above 0, is matched with nothing. The same
/// bits at any number of threads and on every processor. PreconditionError where the descriptors or the
/// images' sizes differ.
[[nodiscard]] std::vector<std::optional<StereoMatch>> match_stereo(const Rig& rig, const StereoSide& left,
                                                                   const StereoSide& right,
                                                                   const StereoMatchOptions& options,
                                                                   const Executor& executor = Executor());

}  // namespace cairn
