// SPDX-License-Identifier: Apache-2.0
#include "cairn/features/sift_orientation.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "cairn/features/kernels/patch_kernels.h"
#include "cairn/features/sift_patch.h"

namespace cairn {
namespace {

constexpr double kWindow = 1.5;  // standard deviation of the weights, in sigmas of the point (section 5)
constexpr double kReach = 3;     // of these on either side
constexpr float kPeakShare = 0.8F;
constexpr double kStep = 2 * kReach * kWindow / (kOrientationSide - 1);  // between samples, in sigmas

using Histogram = std::array<float, kOrientationBins>;
using Weights = std::array<float, kOrientationSide * kOrientationSide>;

/// Weights of the gradients between samples; none for those beyond the last column.
Weights make_weights() {
  Weights weights{};
  constexpr int kGradients = kOrientationSide - 1;
  for (int i = 0; i < kGradients; ++i) {
    for (int j = 0; j < kGradients; ++j) {
      const double x = (j - (kGradients - 1) / 2.0) * kStep, y = (i - (kGradients - 1) / 2.0) * kStep;
      weights.data()[i * kOrientationSide + j] =
          static_cast<float>(std::exp(-(x * x + y * y) / (2 * kWindow * kWindow)));
    }
  }
  return weights;
}

/// Values around bin b, circular.
float at(const Histogram& histogram, int b) {
  if (b < 0) b += kOrientationBins;
  return histogram[static_cast<std::size_t>(b < kOrientationBins ? b : b - kOrientationBins)];
}

/// Binomial filter over five bins.
Histogram smoothed(const Histogram& histogram) {
  Histogram smooth{};
  for (int b = 0; b < kOrientationBins; ++b) {
    smooth[static_cast<std::size_t>(b)] = (at(histogram, b - 2) + at(histogram, b + 2)) * (1.0F / 16) +
                                          (at(histogram, b - 1) + at(histogram, b + 1)) * (4.0F / 16) +
                                          at(histogram, b) * (6.0F / 16);
  }
  return smooth;
}

struct Peak {
  float height, angle_deg;
};

/// A parabola through a bin that is a local maximum and its neighbours.
Peak refine(const Histogram& histogram, int b) {
  const float before = at(histogram, b - 1), here = at(histogram, b), after = at(histogram, b + 1);
  const float curvature = before - 2 * here + after;
  const float offset = curvature < 0 ? 0.5F * (before - after) / curvature : 0;
  constexpr float kBinDegrees = 360.0F / kOrientationBins;
  float angle = (static_cast<float>(b) + offset) * kBinDegrees;
  if (angle < 0) angle += 360.0F;
  if (angle >= 360.0F) angle -= 360.0F;
  return {here, angle};
}

}  // namespace

std::vector<float> sift_orientations(const ScaleSpace& space, const ScalePoint& point) {
  static const Weights kWeights = make_weights();
  std::array<float, kOrientationSide * kOrientationSide + kPatchSlack> samples{};
  sample_patch(space, point, {0, kStep, kOrientationSide - 1, kOrientationSide}, samples.data());
  Histogram raw{};
  patch_kernels().orientations(samples.data(), kWeights.data(), raw.data());
  const Histogram histogram = smoothed(raw);
  const float least = kPeakShare * *std::max_element(histogram.begin(), histogram.end());
  std::vector<Peak> peaks;
  for (int b = 0; b < kOrientationBins; ++b) {
    const float here = at(histogram, b);
    if (here >= least && here > at(histogram, b - 1) && here >= at(histogram, b + 1))
      peaks.push_back(refine(histogram, b));
  }
  std::stable_sort(peaks.begin(), peaks.end(),
                   [](const Peak& a, const Peak& b) { return a.height > b.height; });
  std::vector<float> angles;
  for (const Peak& peak : peaks) angles.push_back(peak.angle_deg);
  if (angles.empty()) angles.push_back(0);  // no direction prevails
  return angles;
}

}  // namespace cairn
