// SPDX-License-Identifier: Apache-2.0
#include "cairn/features/sift_resize.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "cairn/features/kernels/blur_kernels.h"

namespace cairn {
namespace {

constexpr int kReach = 2;  // pixels around the nearest two: 3 standard deviations of the first blur

/// Weights of the pixels around a point: those k pixels beyond the nearest on either side.
struct Phase {
  std::array<float, kReach + 1> weights{};
  int pairs = kReach + 1;
};

/// How pixels at even places and at odd ones, between pixels, are made.
struct Phases {
  Phase at_pixel, between;
};

Phase gaussian_phase(double sigma, double offset) {
  Phase phase;
  std::array<double, kReach + 1> weights{};
  double sum = 0;
  for (std::size_t k = 0; k < weights.size(); ++k) {
    const double distance = offset + static_cast<double>(k);
    weights[k] = distance > kReach ? 0 : std::exp(-distance * distance / (2 * sigma * sigma));
    if (distance == 0) weights[k] /= 2;  // the centre is added to itself
    sum += 2 * weights[k];
  }
  for (std::size_t k = 0; k < weights.size(); ++k) phase.weights[k] = static_cast<float>(weights[k] / sum);
  return phase;
}

/// Lagrange's polynomial through six pixels, half-way between the middle two.
Phases interpolation() {
  return {{{0.5F}, 1}, {{150.0F / 256, -25.0F / 256, 3.0F / 256}, kReach + 1}};
}

/// Doubles rows first, then columns.
class Doubling {
 public:
  /// copy_row(v, out) gives row v of the image of that size.
  Doubling(int width, int height, std::function<void(int, float*)> copy_row, const Phases& phases)
      : width_(width), height_(height), copy_row_(std::move(copy_row)), phases_(phases) {}

  /// Rows [begin, end) of the doubled image; row `begin` becomes row 0 of `to`.
  void run(int begin, int end, const ScaleLevel& to) const {
    const int first = begin / 2 - kReach, last = (end - 1) / 2 + kReach + 1, rows = last - first + 1;
    const AlignedFloats floats(static_cast<std::size_t>(rows) * static_cast<std::size_t>(to.stride));
    const ScaleLevel wide{floats.data(), to.width, rows, to.stride};  // twice as wide only
    PaddedRows phases(width_, 3, kReach + 1);
    for (int v = first; v <= last; ++v) double_row(v, phases, wide, wide.row(v - first));
    const RowTable table(wide, 0, rows, kReach);
    for (int v = begin; v < end; ++v) {
      const Phase& phase = v % 2 == 0 ? phases_.at_pixel : phases_.between;
      blur_kernels().sum_rows(table.at(v / 2 - first), v % 2, phase.weights.data(), phase.pairs, 0,
                              round_up(to.width, kBlurStep), to.row(v - begin));
    }
  }

 private:
  /// One row; `rows` are room for it, for what is filtered at its pixels, and for that between them.
  void double_row(int v, PaddedRows& rows, const ScaleLevel& to, float* out) const {
    copy_row_(std::clamp(v, 0, height_ - 1), rows.row(0));
    rows.pad(0);
    const float *even = filter(rows, 0, phases_.at_pixel), *odd = filter(rows, 1, phases_.between);
    for (int x = 0; x < to.width / 2; ++x) {
      out[2 * x] = even[x];
      out[2 * x + 1] = odd[x];
    }
    if (to.width % 2 == 1) out[to.width - 1] = even[to.width / 2];
    std::fill(out + to.width, out + to.stride, out[to.width - 1]);
  }

  /// Along the row: the sum of the row moved by some pixels.
  const float* filter(PaddedRows& rows, int shift, const Phase& phase) const {
    std::array<const float*, 2 * kReach + 2> moved{};
    for (std::size_t k = 0; k < moved.size(); ++k)
      moved[k] = rows.row(0) + static_cast<std::ptrdiff_t>(k) - kReach;
    float* out = rows.row(1 + shift);
    blur_kernels().sum_rows(moved.data() + kReach, shift, phase.weights.data(), phase.pairs, 0,
                            round_up(width_, kBlurStep), out);
    return out;
  }

  int width_, height_;
  std::function<void(int, float*)> copy_row_;
  Phases phases_;
};

}  // namespace

void double_smoothed(const GrayImage& image, double sigma, const ScaleLevel& to, const Executor& executor) {
  const Phases phases{gaussian_phase(sigma, 0), gaussian_phase(sigma, 0.5)};
  const auto copy_row = [&](int v, float* out) { std::copy_n(image.row(v), image.width(), out); };
  const Doubling doubling(image.width(), image.height(), copy_row, phases);
  for_each_strip(to.height, executor, [&](int begin, int end) {
    doubling.run(begin, end, {to.row(begin), to.width, end - begin, to.stride});
  });
}

void double_smooth(const ScaleLevel& from, int begin, int end, const ScaleLevel& to) {
  const auto copy_row = [&](int v, float* out) { std::copy_n(from.row(v), from.width, out); };
  Doubling(from.width, from.height, copy_row, interpolation()).run(begin, end, to);
}

void halve(const ScaleLevel& from, const ScaleLevel& to) {
  for (int v = 0; v < to.height; ++v) {
    const float* in = from.row(2 * v);
    float* out = to.row(v);
    for (int x = 0; x < to.width; ++x) out[x] = in[2 * x];
    std::fill(out + to.width, out + to.stride, out[to.width - 1]);
  }
}

}  // namespace cairn
