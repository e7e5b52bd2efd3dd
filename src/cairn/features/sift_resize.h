// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cairn/core/executor.h"
#include "cairn/features/sift_rows.h"
#include "cairn/image/image.h"

/// Between octaves. Pixel (x, y) of the smaller image lies at (2 x, 2 y) of the larger, whose last column and
/// row may be beyond the smaller one's last or not.
namespace cairn {

/// Doubles the image and smooths by a Gaussian of `sigma` pixels of the image in one: the Gaussian of the
/// image's pixels, evaluated at pixels and half-way between them. `to` has twice the image's size.
void double_smoothed(const GrayImage& image, double sigma, const ScaleLevel& to, const Executor& executor);

/// Doubles by the interpolation of fifth order, for images so smooth that it changes nothing: twice
/// kSiftSigma pixels of `to`. `to` may have one column or row less than twice as many.
void double_smooth(const ScaleLevel& from, const ScaleLevel& to, const Executor& executor);

/// Every second pixel of every second row.
void halve(const ScaleLevel& from, const ScaleLevel& to);

}  // namespace cairn
