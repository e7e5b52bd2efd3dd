// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cairn/core/executor.h"
#include "cairn/features/sift_rows.h"
#include "cairn/image/image.h"

/// Converts images between octaves. Pixel (x, y) of the smaller image lies at (2 x, 2 y) of the larger, whose
/// last column and row may lie beyond the smaller one's last or not.
namespace cairn {

/// Doubles the image and smooths it by a Gaussian of `sigma` pixels of the image in one step: the Gaussian is
/// evaluated at pixels and half-way between them. `to` has twice the image's size.
void double_smoothed(const GrayImage& image, double sigma, const ScaleLevel& to, const Executor& executor);

/// Computes rows [begin, end) of the doubled image by interpolation of fifth order, for images so smooth that
/// this changes nothing: kSiftSigma of their pixels. Row `begin` becomes row 0 of `to`, which may be one
/// column narrower than twice `from`.
void double_smooth(const ScaleLevel& from, int begin, int end, const ScaleLevel& to);

/// Takes every second pixel of every second row.
void halve(const ScaleLevel& from, const ScaleLevel& to);

}  // namespace cairn
