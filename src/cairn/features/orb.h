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

/// ORB: FAST corners on a pyramid, turned by their intensity centroid, described by rotated BRIEF (Rublee,
/// Rabaud, Konolige and Bradski, ICCV 2011).
struct OrbOptions {
  int count = 1000;         ///< at most so many keypoints, at least 1
  int levels = 8;           ///< of the pyramid, at least 1
  double scale = 1.2;       ///< from level to level, in (1, 1.8]
  int threshold = 20;       ///< FAST's, grey levels, [1, 254]
  int retry_threshold = 7;  ///< in cells of 32 pixels without a corner; [1, threshold]
};

/// Finds and describes keypoints; none where the image is smaller than a patch (37 pixels along a side).
[[nodiscard]] Features extract_orb(const GrayImage& image, const OrbOptions& options,
                                   const Executor& executor = Executor());

[[nodiscard]] std::unique_ptr<Extractor> make_orb_extractor(const OrbOptions& options);

// The single steps, on one image without a pyramid.

/// Direction from a pixel to the centroid of the intensities in the disc of radius 15 around it, degrees in
/// [0, 360), clockwise from the x axis (Rosin 1999); 0 where the centroid is the pixel itself. The disc lies
/// in the image.
[[nodiscard]] float angle_by_moments(const GrayImage& image, int u, int v);

struct OrbDescriptions {
  std::vector<float> angles_deg;  ///< of each keypoint; -1 where it is bad
  Descriptors descriptors;        ///< 32 bytes each; zeros where it is bad
  std::vector<bool> bad;          ///< the keypoint's patch leaves the image, or its place is no number
  int bad_count = 0;
};

/// Angle and 256-bit rotated BRIEF of given keypoints (their u and v, rounded; angle and size do not matter).
/// Angles are taken from the image as it is, bits from the image smoothed by smooth_for_brief.
[[nodiscard]] OrbDescriptions describe_orb(const GrayImage& image, std::span<const Keypoint> keypoints,
                                           const Executor& executor = Executor());

}  // namespace cairn
