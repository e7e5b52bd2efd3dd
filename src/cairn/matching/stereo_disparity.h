// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "cairn/image/image.h"

namespace cairn {

/// Describes the disparity at one position of a rectified pair, measured on the images.
struct MeasuredDisparity {
  double disparity = 0;    ///< pixels, at the position asked for
  double sigma_px = 0;     ///< standard deviation, from the window's texture and the residuals
  double correlation = 0;  ///< share of the left window's variance that the right one explains, at most 1
};

/// Says if a disparity was measured and, if not, why.
enum class DisparityStatus {
  measured,
  no_room,      ///< the window would leave an image
  no_texture,   ///< the window has too little texture
  not_settled,  ///< the result lies more than a pixel beyond the reach, or the iteration did not converge
};

/// Holds the result of measure_disparity.
struct DisparityResult {
  DisparityStatus status = DisparityStatus::no_room;
  MeasuredDisparity measured;  ///< valid only with status measured; always finite
};

/// Measures the disparity by least-squares matching along the row (Lucas and Kanade 1981; with the gradients
/// of the left window, as Baker and Matthews 2004, sec. 3.2) of a window of 15x13 pixels around (u, v) of
/// `left`, weighted towards its centre. The unknowns are the disparity, its slopes along u and v (a road's
/// disparity grows by a third of a pixel per row), a gain and an offset. The gradients' noise is independent
/// of the right image's and, at the centre of a symmetric difference, of the left one's, so that noise does
/// not bias the result; interpolation between six pixels keeps the fraction of a pixel from biasing it.
/// `guess` is the initial disparity and `reach_px` (>= 0) how far from it the true one may lie. Gives the
/// same bits on every processor. Throws PreconditionError if the images' sizes differ or `reach_px` is
/// negative.
[[nodiscard]] DisparityResult measure_disparity(const GrayImage& left, const GrayImage& right, double u,
                                                double v, double guess, double reach_px);

/// Finds the whole disparity in [first, last] at which the windows differ least, apart from an offset.
/// Returns nullopt if another one, more than two pixels away, is nearly as good, or if the right window,
/// searched in the left image, is found elsewhere: occlusions and repeated texture. Gives the same bits on
/// every processor. Throws PreconditionError if the images' sizes differ.
[[nodiscard]] std::optional<int> find_disparity(const GrayImage& left, const GrayImage& right, double u,
                                                double v, int first, int last);

}  // namespace cairn
