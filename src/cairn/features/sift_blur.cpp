// SPDX-License-Identifier: Apache-2.0
#include "cairn/features/sift_blur.h"

#include <cmath>

#include "cairn/features/kernels/blur_kernels.h"

namespace cairn {
namespace {

constexpr double kTruncation = 2.5;  // standard deviations on either side; more finds no better features

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

/// A separable filter; weights of the centre and of its neighbours on one side.
class Blur {
 public:
  Blur(const ScaleLevel& from, const std::vector<float>& weights, const ScaleLevel& to)
      : from_(from), weights_(weights), halved_(weights), to_(to) {
    halved_[0] /= 2;  // sum_rows adds the centre row to itself
  }

  void run(const Executor& executor) const {
    for_each_strip(to_.height, executor, [&](int begin, int end) {
      const RowTable table(from_, begin, end, radius());
      PaddedRows between(from_.width, 1, radius());
      for (int v = begin; v < end; ++v) blur_row(table.at(v), between, to_.row(v));
    });
  }

 private:
  [[nodiscard]] int radius() const { return static_cast<int>(weights_.size()) - 1; }

  void blur_row(const float* const* rows, PaddedRows& between, float* out) const {
    const int columns = round_up(from_.width, kBlurStep);
    blur_kernels().sum_rows(rows, 0, halved_.data(), radius() + 1, 0, columns, between.row(0));
    between.pad(0);
    blur_kernels().blur_row(between.row(0), weights_.data(), radius(), columns, out);
  }

  const ScaleLevel& from_;
  const std::vector<float>& weights_;
  std::vector<float> halved_;
  const ScaleLevel& to_;
};

}  // namespace

std::vector<float> gaussian_weights(double sigma) {
  // Sampled and truncated, a Gaussian is narrower than it should be; it is widened until its variance is
  // right, so that scales are.
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

void blur(const ScaleLevel& from, const std::vector<float>& weights, const ScaleLevel& to,
          const Executor& executor) {
  Blur(from, weights, to).run(executor);
}

}  // namespace cairn
