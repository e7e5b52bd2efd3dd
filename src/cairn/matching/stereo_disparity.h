// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "cairn/image/image.h"

namespace cairn {

/// Disparity of one place of a rectified pair, measured on the images.
struct MeasuredDisparity {
  double disparity = 0;    ///< pixels, at the place asked for
  double sigma_px = 0;     ///< its standard deviation, from the window's texture and what does not fit
  double correlation = 0;  ///< share of the left window's variance that the right one explains, at most 1
};

enum class DisparityStatus {
  measured,
  no_room,      ///< the window would leave an image
  no_texture,   ///< the window does not decide
  not_settled,  ///< the best place is more than a pixel beyond the reach, or it would not settle
};

struct DisparityResult {
  DisparityStatus status = DisparityStatus::no_room;
  MeasuredDisparity measured;  ///< only with status measured; always finite
};

/// Least-squares matching along the row (Lucas and Kanade 1981; with the gradients of the left window, as
/// Baker and Matthews 2004, sec. 3.2) of a window of 15x13 pixels around (u, v) of `left`, weighted towards
/// its centre. Solved for are the disparity, its slopes along u and v (a road's disparity grows by a third of
/// a pixel a row), a gain and an offset. The gradients' noise is independent of the right image's and, at the
/// centre of a symmetric difference, of the left one's, so that noise pulls the result to no side; six pixels
/// are interpolated between, so that the fraction of a pixel does not either.
/// `guess` and `reach_px`: disparity to begin from, and how far from it the true one may lie (>= 0).
/// Both images have one size. The same bits on every processor.
[[nodiscard]] DisparityResult measure_disparity(const GrayImage& left, const GrayImage& right, double u,
                                                double v, double guess, double reach_px);

/// The whole disparity in [first, last] at which the windows differ least, but for an offset; nothing where
/// another, more than two pixels away, is nearly as good, or where the right window, looked for in the left
/// image, is found elsewhere: hidden places and repeated texture. The same bits on every processor.
[[nodiscard]] std::optional<int> find_disparity(const GrayImage& left, const GrayImage& right, double u,
                                                double v, int first, int last);

}  // namespace cairn
