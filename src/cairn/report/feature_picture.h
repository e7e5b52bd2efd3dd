// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "cairn/features/features.h"
#include "cairn/image/image.h"
#include "cairn/matching/matching.h"

namespace cairn {

/// The image with a circle around each keypoint as large as its scale, a line from its centre along its
/// angle, coloured by scale from blue (fine) to red (coarse).
[[nodiscard]] RgbImage draw_keypoints(const GrayImage& image, std::span<const Keypoint> keypoints);

/// Both images side by side and a line for each match, coloured by the row of its first keypoint: lines of
/// one colour that are not parallel stand out.
[[nodiscard]] RgbImage draw_matches(const GrayImage& first, std::span<const Keypoint> first_keypoints,
                                    const GrayImage& second, std::span<const Keypoint> second_keypoints,
                                    std::span<const Match> matches);

}  // namespace cairn
