// SPDX-License-Identifier: Apache-2.0
#include "cairn/features/sift_scale_space.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "cairn/core/error.h"
#include "cairn/features/kernels/blur_kernels.h"

namespace cairn {
namespace {

constexpr int kSmallestSide = 16;      // octave pixels: below, no keypoint has room for its surroundings
constexpr double kCameraSigma = 0.25;  // pixels: blur that a sharp image has (Lowe 2004, section 3.3)
constexpr double kTruncation = 2.5;    // standard deviations on either side
constexpr int kStripRows = 16;         // a strip's smoothed columns stay in the cache
constexpr int kTileColumns = 256;      // with the rows that a strip needs: 35 KB
constexpr int kUpsampleReach = 2;      // image pixels: 3 standard deviations of the first blur

int round_up(int value, int step) {
  return (value + step - 1) / step * step;
}

double variance_of(const std::vector<double>& weights) {
  double sum = weights[0], squares = 0;
  for (std::size_t k = 1; k < weights.size(); ++k) {
    sum += 2 * weights[k];
    squares += 2 * weights[k] * static_cast<double>(k * k);
  }
  return squares / sum;
}

std::vector<double> sampled_gaussian(double sigma, int radius) {
  std::vector<double> weights;
  for (int k = 0; k <= radius; ++k) weights.push_back(std::exp(-k * k / (2 * sigma * sigma)));
  return weights;
}

/// Weights of the centre and of its neighbours on one side, of sum 1. Sampled and truncated, a Gaussian is
/// narrower than it should be; it is widened until its variance is right, so that scales are.
std::vector<float> gaussian_weights(double sigma) {
  const int radius = static_cast<int>(std::lround(kTruncation * sigma));
  constexpr int kRounds = 10;
  double widened = sigma;
  for (int round = 0; round < kRounds; ++round)
    widened *= sigma / std::sqrt(variance_of(sampled_gaussian(widened, radius)));
  const std::vector<double> weights = sampled_gaussian(widened, radius);
  double sum = weights[0];
  for (std::size_t k = 1; k < weights.size(); ++k) sum += 2 * weights[k];
  std::vector<float> normalised;
  for (const double weight : weights) normalised.push_back(static_cast<float>(weight / sum));
  return normalised;
}

/// Rows with room on both sides, where their outermost values go on.
class PaddedRows {
 public:
  PaddedRows(int width, int rows, int margin)
      : width_(width),
        margin_(round_up(margin, kBlurStep)),
        stride_(round_up(width, kBlurStep) + 2 * margin_),
        floats_(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(rows)) {}
  [[nodiscard]] float* row(int v) const {
    return floats_.data() + static_cast<std::ptrdiff_t>(v) * stride_ + margin_;
  }
  void pad(int v) {
    float* pixels = row(v);
    std::fill(pixels - margin_, pixels, pixels[0]);
    std::fill(pixels + width_, pixels - margin_ + stride_, pixels[width_ - 1]);
  }

 private:
  int width_, margin_, stride_;
  AlignedFloats floats_;
};

/// Pointers to the rows [begin - margin, end + margin) of a level, whose border rows go on.
class RowTable {
 public:
  RowTable(const ScaleLevel& level, int begin, int end, int margin) : first_(begin - margin) {
    for (int v = begin - margin; v < end + margin; ++v)
      rows_.push_back(level.row(std::clamp(v, 0, level.height - 1)));
  }
  [[nodiscard]] const float* const* at(int v) const { return rows_.data() + (v - first_); }

 private:
  int first_;
  std::vector<const float*> rows_;
};

/// Calls work(begin, end, scratch) for strips of rows.
template <class Scratch, class Work>
void for_each_strip(int height, const Executor& executor, const Scratch& make_scratch, const Work& work) {
  constexpr std::size_t kGrain = 4;  // strips that one thread works on with the same scratch
  const auto strips = static_cast<std::size_t>((height + kStripRows - 1) / kStripRows);
  executor.for_each_chunk(strips, kGrain, [&](std::size_t first, std::size_t last) {
    auto scratch = make_scratch();
    for (std::size_t strip = first; strip < last; ++strip) {
      const int begin = static_cast<int>(strip) * kStripRows;
      work(begin, std::min(height, begin + kStripRows), scratch);
    }
  });
}

/// A separable filter; weights of the centre and of its neighbours on one side.
class Blur {
 public:
  Blur(const ScaleLevel& from, const std::vector<float>& weights, const ScaleLevel& to)
      : from_(from), weights_(weights), halved_(weights), to_(to) {
    halved_[0] /= 2;  // sum_rows adds the centre row to itself
  }

  void run(const Executor& executor) const {
    for_each_strip(
        to_.height, executor, [&] { return PaddedRows(from_.width, kStripRows, radius()); },
        [&](int begin, int end, PaddedRows& rows) {
          blur_columns(begin, end, rows);
          blur_rows(begin, end, rows);
        });
  }

 private:
  [[nodiscard]] int radius() const { return static_cast<int>(weights_.size()) - 1; }

  /// Tile by tile, because of each row many are made.
  void blur_columns(int begin, int end, const PaddedRows& rows) const {
    const RowTable table(from_, begin, end, radius());
    for (int x = 0; x < from_.stride; x += kTileColumns)
      for (int v = begin; v < end; ++v)
        blur_kernels().sum_rows(table.at(v), 0, halved_.data(), radius() + 1, x,
                                std::min(from_.stride, x + kTileColumns), rows.row(v - begin));
  }

  void blur_rows(int begin, int end, PaddedRows& rows) const {
    for (int v = begin; v < end; ++v) {
      rows.pad(v - begin);
      blur_kernels().blur_row(rows.row(v - begin), weights_.data(), radius(), to_.stride, to_.row(v));
    }
  }

  const ScaleLevel& from_;
  const std::vector<float>& weights_;
  std::vector<float> halved_;
  const ScaleLevel& to_;
};

/// Weights of the pixels around a point between pixels: those at `offset` + k and, mirrored, -`offset` - k.
struct PhaseWeights {
  explicit PhaseWeights(double offset) {
    const double sigma = std::sqrt(kSiftSigma * kSiftSigma / 4 - kCameraSigma * kCameraSigma);
    std::array<double, kUpsampleReach + 1> weights{};
    double sum = 0;
    for (std::size_t k = 0; k < weights.size(); ++k) {
      const double distance = offset + static_cast<double>(k);
      weights[k] = distance > kUpsampleReach ? 0 : std::exp(-distance * distance / (2 * sigma * sigma));
      if (distance == 0) weights[k] /= 2;  // the centre is added to itself
      sum += 2 * weights[k];
    }
    for (std::size_t k = 0; k < weights.size(); ++k) values[k] = static_cast<float>(weights[k] / sum);
  }
  std::array<float, kUpsampleReach + 1> values{};
};

/// Doubling and first smoothing in one: the Gaussian that takes the camera's blur to kSiftSigma, of the
/// pixels of the image, evaluated at pixels and half-way between them.
class Upsampler {
 public:
  explicit Upsampler(const GrayImage& image) : image_(image) {}

  void run(const ScaleLevel& to, const Executor& executor) const {
    constexpr int kRows = kStripRows / 2 + 2 * kUpsampleReach + 1;
    for_each_strip(
        to.height, executor,
        [&] {
          return Scratch{AlignedFloats(kRows * static_cast<std::size_t>(to.stride)),
                         PaddedRows(image_.width(), 3, kUpsampleReach + 1)};
        },
        [&](int begin, int end, Scratch& scratch) { upsample_strip(to, begin, end, scratch); });
  }

 private:
  struct Scratch {
    AlignedFloats wide;  ///< image rows of twice the width
    PaddedRows phases;   ///< one image row; filtered at its pixels; filtered between them
  };

  void upsample_strip(const ScaleLevel& to, int begin, int end, Scratch& scratch) const {
    const int first = begin / 2 - kUpsampleReach, last = (end - 1) / 2 + kUpsampleReach + 1;
    const ScaleLevel wide{scratch.wide.data(), to.width, last - first + 1, to.stride};
    for (int v = first; v <= last; ++v) upsample_row(v, scratch.phases, wide.row(v - first));
    const RowTable table(wide, 0, wide.height, kUpsampleReach);
    for (int v = begin; v < end; ++v) {
      const PhaseWeights& weights = v % 2 == 0 ? at_pixel_ : between_;
      blur_kernels().sum_rows(table.at(v / 2 - first), v % 2, weights.values.data(), kUpsampleReach + 1, 0,
                              to.stride, to.row(v));
    }
  }

  void upsample_row(int v, PaddedRows& phases, float* out) const {
    const int width = image_.width();
    const std::uint8_t* pixels = image_.row(std::clamp(v, 0, image_.height() - 1));
    std::copy(pixels, pixels + width, phases.row(0));
    phases.pad(0);
    const float *even = filter(phases, 0, at_pixel_), *odd = filter(phases, 1, between_);
    for (int x = 0; x < width; ++x) {
      out[2 * x] = even[x];
      out[2 * x + 1] = odd[x];
    }
    std::fill(out + 2 * width, out + round_up(2 * width, kBlurStep), out[2 * width - 1]);
  }

  /// Along the row: of the row moved by 0, 1, ... pixels.
  const float* filter(PaddedRows& phases, int shift, const PhaseWeights& weights) const {
    std::array<const float*, 2 * kUpsampleReach + 2> moved{};
    for (std::size_t k = 0; k < moved.size(); ++k)
      moved[k] = phases.row(0) + static_cast<std::ptrdiff_t>(k) - kUpsampleReach;
    float* out = phases.row(1 + shift);
    blur_kernels().sum_rows(moved.data() + kUpsampleReach, shift, weights.values.data(), kUpsampleReach + 1,
                            0, round_up(image_.width(), kBlurStep), out);
    return out;
  }

  const GrayImage& image_;
  PhaseWeights at_pixel_{0}, between_{0.5};
};

/// Every second pixel of every second row.
void halve(const ScaleLevel& from, const ScaleLevel& to) {
  for (int v = 0; v < to.height; ++v) {
    const float* in = from.row(2 * v);
    float* out = to.row(v);
    for (int x = 0; x < to.width; ++x) out[x] = in[2 * x];
    std::fill(out + to.width, out + to.stride, out[to.width - 1]);
  }
}

using Octave = std::vector<ScaleLevel>;

/// The sizes of all levels.
std::vector<Octave> octaves_of(int width, int height, int layers) {
  require(layers >= 1, "an octave has at least one layer");
  std::vector<Octave> octaves;
  for (int w = 2 * width, h = 2 * height; std::min(w, h) >= kSmallestSide; w = (w + 1) / 2, h = (h + 1) / 2)
    octaves.emplace_back(static_cast<std::size_t>(layers) + 3,
                         ScaleLevel{nullptr, w, h, round_up(w, kBlurStep)});
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
  for (std::size_t o = 0; o < octaves_.size(); ++o) {
    if (o == 0) {
      Upsampler(image).run(octaves_[o][0], executor);
    } else {
      halve(octaves_[o - 1][static_cast<std::size_t>(layers_)], octaves_[o][0]);
    }
    for (std::size_t i = 0; i < blurs_.size(); ++i)
      Blur(octaves_[o][i], blurs_[i], octaves_[o][i + 1]).run(executor);
  }
}

}  // namespace cairn
