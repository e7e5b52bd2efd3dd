// SPDX-License-Identifier: Apache-2.0
#include "cairn/features/sift_scale_space.h"

#include <algorithm>
#include <cmath>

#include "cairn/core/error.h"
#include "cairn/features/sift_blur.h"
#include "cairn/features/sift_resize.h"

namespace cairn {
namespace {

constexpr int kSmallestSide = 16;  // octave pixels: below, no keypoint has room for its surroundings
// Pixels: blur that the image has. Lowe assumes 0.5 (section 3.3) but doubles by linear interpolation, whose
// own blur comes on top; here one Gaussian smooths as much as both.
constexpr double kImageSigma = 0.25;

using Octave = std::vector<ScaleLevel>;

/// An odd number of cache lines: at a power of two, the pixels of a column would compete for the same place
/// in the cache.
int stride_of(int width) {
  const int steps = (width + kBlurStep - 1) / kBlurStep;
  return (steps % 2 == 0 ? steps + 1 : steps) * kBlurStep;
}

/// The sizes of all levels.
std::vector<Octave> octaves_of(int width, int height, int layers) {
  require(layers >= 1, "an octave has at least one layer");
  std::vector<Octave> octaves;
  for (int w = 2 * width, h = 2 * height; std::min(w, h) >= kSmallestSide; w = (w + 1) / 2, h = (h + 1) / 2)
    octaves.emplace_back(std::max(layers, 2) + 1, ScaleLevel{nullptr, w, h, stride_of(w)});
  if (!octaves.empty()) octaves.back().resize(static_cast<std::size_t>(layers) + 3, octaves.back().front());
  return octaves;
}

std::size_t floats_of(const std::vector<Octave>& octaves) {
  std::size_t floats = 0;
  for (const Octave& octave : octaves)
    for (const ScaleLevel& level : octave)
      floats += static_cast<std::size_t>(level.stride) * static_cast<std::size_t>(level.height);
  return floats;
}

}  // namespace

ScaleSpace::ScaleSpace(int width, int height, int layers)
    : width_(width),
      height_(height),
      layers_(layers),
      octaves_(octaves_of(width, height, layers)),
      memory_(floats_of(octaves_)) {
  float* next = memory_.data();
  for (Octave& octave : octaves_) {
    for (ScaleLevel& level : octave) {
      level.pixels = next;
      next = level.row(level.height);
    }
  }
  for (int i = 0; i < layers + 2; ++i)
    blurs_.push_back(gaussian_weights(std::sqrt(std::pow(sigma(i + 1), 2) - std::pow(sigma(i), 2))));
}

double ScaleSpace::sigma(double level) const {
  return kSiftSigma * std::exp2(level / layers_);
}

double ScaleSpace::pixel_size(int octave) {
  return std::ldexp(0.5, octave);
}

void ScaleSpace::build(const GrayImage& image, const Executor& executor) {
  require(image.width() == width_ && image.height() == height_, "the image has the size of its scale space");
  const auto layers = static_cast<std::size_t>(layers_);
  for (std::size_t o = 0; o < octaves_.size(); ++o) {
    Octave& octave = octaves_[o];
    if (o == 0) {
      constexpr double kFirstSigma = kSiftSigma / 2;  // in pixels of the image
      double_smoothed(image, std::sqrt(kFirstSigma * kFirstSigma - kImageSigma * kImageSigma), octave[0],
                      executor);
    } else {
      halve(octaves_[o - 1][layers], octave[0]);
    }
    for (std::size_t i = 0; i + 1 < octave.size(); ++i) blur(octave[i], blurs_[i], octave[i + 1], executor);
  }
}

OctaveRows::OctaveRows(const ScaleSpace& space, int octave, int begin, int end)
    : begin_(std::max(0, begin)),
      end_(std::min(space.level(octave, 0).height, end)),
      made_(2 * static_cast<std::size_t>(end_ - begin_) *
            static_cast<std::size_t>(space.level(octave, 0).stride)) {
  const ScaleLevel& base = space.level(octave, 0);
  for (int i = 0; i < space.level_count(octave); ++i)
    levels_.push_back({space.level(octave, i).row(begin_), base.width, end_ - begin_, base.stride});
  float* pixels = made_.data();
  for (int i = space.level_count(octave); i < space.layers() + 3; ++i) {
    levels_.push_back({pixels, base.width, end_ - begin_, base.stride});
    double_smooth(space.level(octave + 1, i - space.layers()), begin_, end_, levels_.back());
    pixels = levels_.back().row(end_ - begin_);
  }
}

}  // namespace cairn
