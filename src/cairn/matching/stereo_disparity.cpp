// SPDX-License-Identifier: Apache-2.0
#include "cairn/matching/stereo_disparity.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <vector>

#include "cairn/core/error.h"
#include "cairn/matching/kernels/disparity_kernels.h"

namespace cairn {
namespace {

using Matrix = Eigen::Matrix<double, DisparityNormal::kUnknowns, DisparityNormal::kUnknowns>;
using Vector = Eigen::Matrix<double, DisparityNormal::kUnknowns, 1>;
enum Unknown { along_row, slope_u, slope_v, gain, offset };

constexpr double kMaxSlope = 1;  // pixels a pixel: steeper surfaces look different in the two images

Matrix to_matrix(const DisparityNormal& normal) {
  Matrix matrix;
  const double* next = normal.matrix;
  for (int i = 0; i < DisparityNormal::kUnknowns; ++i)
    for (int j = i; j < DisparityNormal::kUnknowns; ++j) matrix(i, j) = matrix(j, i) = *next++;
  return matrix;
}

/// One window of the left image, to be found in the right one.
class Window {
 public:
  Window(const GrayImage& left, const GrayImage& right, int u, int v)
      : right_(right), kernels_(disparity_kernels()), u_(u), v_(v) {
    DisparityNormal normal;
    kernels_.prepare(left.row(v) + u, left.width(), window_, normal);
    normal_ = to_matrix(normal);
  }

  static bool has_room(const GrayImage& left, int u, int v) {
    constexpr int kLeft = DisparityWindow::kLeft + DisparityWindow::kGradientReach;
    constexpr int kRight = DisparityWindow::kWidth - DisparityWindow::kLeft + DisparityWindow::kGradientReach;
    constexpr int kHalf = DisparityWindow::kHalfHeight;
    return u >= kLeft && u + kRight <= left.width() && v >= kHalf && v + kHalf < left.height();
  }

  [[nodiscard]] bool has_room(double disparity, double row_slope) const {
    constexpr double kLeft = DisparityWindow::kLeft + DisparityWindow::kInterpolationReach;
    constexpr double kRight =
        DisparityWindow::kWidth - DisparityWindow::kLeft + DisparityWindow::kInterpolationReach;
    const double spread = std::abs(row_slope) * DisparityWindow::kHalfHeight;
    const double centre = u_ - disparity;
    return centre - spread >= kLeft && centre + spread + kRight <= right_.width();
  }

  /// False where there is too little texture for the unknowns.
  [[nodiscard]] bool invert() {
    constexpr double kMinDeterminant = 1e-6;  // of the matrix scaled to a diagonal of ones
    const Vector scale = normal_.diagonal().cwiseMax(1e-9).cwiseSqrt().cwiseInverse();
    const Matrix scaled = scale.asDiagonal() * normal_ * scale.asDiagonal();
    const Eigen::LLT<Matrix> factors(scaled);
    const double root = factors.matrixLLT().diagonal().prod();
    if (factors.info() != Eigen::Success || !(root * root > kMinDeterminant)) return false;
    inverse_ = scale.asDiagonal() * factors.solve(Matrix::Identity()) * scale.asDiagonal();
    return true;
  }

  /// Of the windows' pixels less their means: weighted squares.
  [[nodiscard]] double difference(int disparity) const {
    DisparityDifference result;
    kernels_.difference(window_, right_.row(v_) + u_, right_.width(), disparity, result);
    return result.squares - result.sum * result.sum / total_weight();
  }

  [[nodiscard]] DisparityResiduals compare(double disparity, double row_slope) const {
    DisparityResiduals residuals;
    kernels_.compare(window_, right_.row(v_) + u_, right_.width(), static_cast<float>(disparity),
                     static_cast<float>(row_slope), residuals);
    return residuals;
  }

  [[nodiscard]] const Matrix& inverse() const { return inverse_; }
  [[nodiscard]] double total_weight() const { return normal_(offset, offset); }
  [[nodiscard]] double variance_sum() const {
    return normal_(gain, gain) - normal_(gain, offset) * normal_(gain, offset) / total_weight();
  }

 private:
  const GrayImage& right_;
  const DisparityKernels& kernels_;
  int u_, v_;
  DisparityWindow window_;
  Matrix normal_, inverse_;
};

/// The guess, or the whole disparity within its reach where the windows differ less, but for an offset.
double search(const Window& window, double guess, double reach_px) {
  const int first = static_cast<int>(std::floor(guess - reach_px + 0.5));
  const int last = static_cast<int>(std::floor(guess + reach_px + 0.5));
  int best = first;
  double least = std::numeric_limits<double>::infinity();
  for (int disparity = first; disparity <= last; ++disparity) {
    if (!window.has_room(disparity, 0)) continue;
    const double difference = window.difference(disparity);
    if (difference < least) least = difference, best = disparity;
  }
  constexpr double kSamePixel = 0.5;
  return std::abs(best - guess) <= kSamePixel ? guess : best;
}

struct Fit {
  bool settled = false;
  double disparity = 0, slope_u = 0, slope_v = 0;
  double squares = 0;  // what does not fit
};

/// Gives up where it leaves the reach around the guess.
Fit settle(const Window& window, double begin, double guess, double reach_px) {
  constexpr int kMaxSteps = 10;
  constexpr double kSettled = 0.02;  // pixels
  constexpr double kMaxBeyond = 1;   // pixels: the guess's reach is a standard deviation, not a wall
  Fit fit;
  fit.disparity = begin;
  for (int step = 0; step < kMaxSteps && !fit.settled; ++step) {
    if (!window.has_room(fit.disparity, fit.slope_v)) return fit;
    const DisparityResiduals residuals = window.compare(fit.disparity, fit.slope_v);
    const Vector projected = Vector::Map(residuals.projected);
    const Vector solved = window.inverse() * projected;
    fit.disparity -= solved[along_row];
    fit.slope_v -= solved[slope_v];
    fit.slope_u = -solved[slope_u];
    fit.squares = std::max(0.0, residuals.squares - projected.dot(solved));
    const bool within = std::abs(fit.disparity - guess) <= reach_px + kMaxBeyond;
    if (!within || !(std::abs(fit.slope_v) <= kMaxSlope)) return fit;
    fit.settled = std::abs(solved[along_row]) < kSettled;
  }
  return fit;
}

MeasuredDisparity summarise(const Window& window, const Fit& fit, double du, double dv) {
  // What noise alone explains is too little by this factor on simulated streets: surfaces bend within a
  // window, and what does not fit is not independent from pixel to pixel.
  constexpr double kBeyondNoise = 1.4;
  constexpr double kRounding = 1.0 / 12 + 1.0 / 12;  // variance of both images' rounding to grey levels
  MeasuredDisparity measured;
  measured.disparity = fit.disparity + fit.slope_u * du + fit.slope_v * dv;
  const double noise = std::max(kRounding, fit.squares / window.total_weight());
  measured.sigma_px = kBeyondNoise * std::sqrt(noise * window.inverse()(along_row, along_row));
  measured.correlation = 1 - fit.squares / std::max(window.variance_sum(), 1e-9);
  return measured;
}

/// The disparity of the least difference, where no other place is nearly as good.
std::optional<int> find_alone(const Window& window, int first, int last) {
  constexpr int kOnePlace = 2;           // pixels: within, it is the same minimum
  constexpr double kMinAdvantage = 1.5;  // of the next best; as 0.8 for the ratio of distances (Lowe 2004)
  std::vector<double> differences;
  for (int disparity = first; disparity <= last; ++disparity)
    differences.push_back(window.has_room(disparity, 0) ? window.difference(disparity)
                                                        : std::numeric_limits<double>::infinity());
  const auto best = std::min_element(differences.begin(), differences.end());
  if (best == differences.end() || !std::isfinite(*best)) return std::nullopt;
  for (auto other = differences.begin(); other != differences.end(); ++other) {
    if (std::abs(other - best) > kOnePlace && *other < kMinAdvantage * *best) return std::nullopt;
  }
  return first + static_cast<int>(best - differences.begin());
}

}  // namespace

std::optional<int> find_disparity(const GrayImage& left, const GrayImage& right, double u, double v,
                                  int first, int last) {
  require(left.width() == right.width() && left.height() == right.height(), "both images have one size");
  if (!(u >= 0 && v >= 0 && u < left.width() && v < left.height())) return std::nullopt;
  const int column = static_cast<int>(u + 0.5), row = static_cast<int>(v + 0.5);
  if (!Window::has_room(left, column, row)) return std::nullopt;
  const auto there = find_alone(Window(left, right, column, row), first, last);
  if (!there || !Window::has_room(right, column - *there, row)) return std::nullopt;
  const auto back = find_alone(Window(right, left, column - *there, row), -last, -first);
  constexpr int kSame = 1;  // pixels
  return back && std::abs(*back + *there) <= kSame ? there : std::nullopt;
}

DisparityResult measure_disparity(const GrayImage& left, const GrayImage& right, double u, double v,
                                  double guess, double reach_px) {
  require(left.width() == right.width() && left.height() == right.height(), "both images have one size");
  require(reach_px >= 0, "the reach is not negative");
  if (!(u >= 0 && v >= 0 && u < left.width() && v < left.height() && std::isfinite(guess)))
    return {DisparityStatus::no_room, {}};
  const int column = static_cast<int>(u + 0.5), row = static_cast<int>(v + 0.5);
  if (!Window::has_room(left, column, row)) return {DisparityStatus::no_room, {}};
  Window window(left, right, column, row);
  if (!window.has_room(guess, 0)) return {DisparityStatus::no_room, {}};
  if (!window.invert()) return {DisparityStatus::no_texture, {}};
  const Fit fit = settle(window, search(window, guess, reach_px), guess, reach_px);
  if (!fit.settled) return {DisparityStatus::not_settled, {}};
  return {DisparityStatus::measured, summarise(window, fit, u - column, v - row)};
}

}  // namespace cairn
