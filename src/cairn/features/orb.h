// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "cairn/core/executor.h"
#include "cairn/features/extractor.h"
#include "cairn/features/fast.h"
#include "cairn/features/features.h"
#include "cairn/image/image.h"

namespace cairn {

/// Sets ORB: FAST corners on a pyramid, oriented by their intensity centroid, described by rotated BRIEF
/// (Rublee, Rabaud, Konolige and Bradski, ICCV 2011).
struct OrbOptions {
  int count = 1000;         ///< maximum number of keypoints, at least 1
  int levels = 8;           ///< levels of the pyramid, at least 1
  double scale = 1.2;       ///< factor between levels, in (1, 1.8]
  int threshold = 20;       ///< threshold of FAST, grey levels, [1, 254]
  int retry_threshold = 7;  ///< threshold in cells of 64 pixels without a corner, [1, threshold]
};

/// Detects and describes keypoints; finds none if a side of the image is below 39 pixels. Throws
/// PreconditionError if an option is out of range.
[[nodiscard]] Features extract_orb(const GrayImage& image, const OrbOptions& options,
                                   const Executor& executor = Executor());

/// Makes an extractor that calls extract_orb.
[[nodiscard]] std::unique_ptr<Extractor> make_orb_extractor(const OrbOptions& options);

// The single steps, on one image without a pyramid.

/// Computes the direction from a pixel to the centroid of the intensities in the disc of radius 15 around it,
/// degrees in [0, 360), clockwise from the x axis (Rosin 1999); 0 if the centroid is the pixel itself. Throws
/// PreconditionError unless the pixel lies at least 19 pixels inside the image.
[[nodiscard]] float angle_by_moments(const GrayImage& image, int u, int v);

/// Holds the result of describe_orb.
struct OrbDescriptions {
  std::vector<float> angles_deg;  ///< one for each keypoint; -1 if it is bad
  Descriptors descriptors;        ///< 32 bytes each; zeros if the keypoint is bad
  std::vector<bool> bad;          ///< the keypoint's patch leaves the image, or its position is not finite
  int bad_count = 0;
};

/// Computes angle and 256-bit rotated BRIEF of given keypoints (at their rounded u and v; their angle and
/// size are not used). Takes angles from the image itself, bits from the image smoothed by smooth_for_brief.
[[nodiscard]] OrbDescriptions describe_orb(const GrayImage& image, std::span<const Keypoint> keypoints,
                                           const Executor& executor = Executor());

}  // namespace cairn
