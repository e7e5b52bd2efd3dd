// SPDX-License-Identifier: Apache-2.0
#include "cairn/matching/window_offset.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

#include "cairn/core/error.h"

namespace cairn {
namespace {

constexpr int kHalf = 7;  // of the window, pixels
constexpr int kSide = 2 * kHalf + 1;
constexpr int kUnknowns = 6;  // column, row, slopes along u and v, gain, brightness
using Vector = Eigen::Matrix<double, kUnknowns, 1>;
using Matrix = Eigen::Matrix<double, kUnknowns, kUnknowns>;

/// Returns the factors of four neighbouring pixels at a share of a pixel behind the second (Keys 1981,
/// a = -1/2).
std::array<double, 4> cubic_factors(double t) {
  const double t2 = t * t, t3 = t2 * t;
  return {0.5 * (-t3 + 2 * t2 - t), 0.5 * (3 * t3 - 5 * t2 + 2), 0.5 * (-3 * t3 + 4 * t2 + t),
          0.5 * (t3 - t2)};
}

bool has_room(const GrayImage& image, double u, double v, double margin) {
  return u >= margin && v >= margin && u <= image.width() - 1 - margin && v <= image.height() - 1 - margin;
}

double interpolate(const GrayImage& image, double u, double v) {
  const double left = std::floor(u), top = std::floor(v);
  const auto across = cubic_factors(u - left), down = cubic_factors(v - top);
  double sum = 0;
  for (int y = 0; y < 4; ++y) {
    const std::uint8_t* pixel = image.row(static_cast<int>(top) + y - 1) + static_cast<int>(left) - 1;
    double row = 0;
    for (int x = 0; x < 4; ++x) row += across[static_cast<std::size_t>(x)] * static_cast<double>(pixel[x]);
    sum += down[static_cast<std::size_t>(y)] * row;
  }
  return sum;
}

/// Holds what is solved for: the offset and how its column changes over the window.
struct Motion {
  Eigen::Vector2d offset;
  double slope_u = 0, slope_v = 0;
};

/// Holds a window of the first image and the normal equations of its motion.
class OffsetWindow {
 public:
  OffsetWindow(const GrayImage& image, int u, int v) : u_(u), v_(v) {
    Matrix normal = Matrix::Zero();
    for (int y = -kHalf; y <= kHalf; ++y) {
      for (int x = -kHalf; x <= kHalf; ++x) {
        Pixel& pixel = pixels_[next_++];
        const int c = u + x, r = v + y;
        pixel.weight = std::exp(-(x * x + y * y) / (2.0 * kSigma * kSigma));
        pixel.grey = static_cast<double>(image(c, r));
        const double along = derivative(image(c - 2, r), image(c - 1, r), image(c + 1, r), image(c + 2, r));
        const double across = derivative(image(c, r - 2), image(c, r - 1), image(c, r + 1), image(c, r + 2));
        pixel.jacobian << along, across, along * x, along * y, pixel.grey - kMiddleGrey, 1.0;
        normal.noalias() += pixel.weight * pixel.jacobian * pixel.jacobian.transpose();
        weight_ += pixel.weight;
      }
    }
    factorise(normal);
  }

  [[nodiscard]] bool textured() const { return textured_; }

  /// Improves the motion by one step. Returns its length in pixels, or nullopt where the window leaves
  /// `other`.
  [[nodiscard]] std::optional<double> step(const GrayImage& other, Motion& motion) {
    Vector projected = Vector::Zero();
    double squares = 0;
    std::size_t next = 0;
    for (int y = -kHalf; y <= kHalf; ++y) {
      for (int x = -kHalf; x <= kHalf; ++x) {
        const double c = u_ + x + motion.offset.x() + motion.slope_u * x + motion.slope_v * y;
        const double r = v_ + y + motion.offset.y();
        if (!has_room(other, c, r, 2)) return std::nullopt;
        const Pixel& pixel = pixels_[next++];
        const double error = pixel.grey - interpolate(other, c, r);
        projected.noalias() += pixel.weight * error * pixel.jacobian;
        squares += pixel.weight * error * error;
      }
    }
    const Vector solved = inverse_ * projected;
    squares_ = std::max(0.0, squares - projected.dot(solved));
    motion.offset += solved.head<2>();
    motion.slope_u += solved[2];
    motion.slope_v += solved[3];
    return solved.head<2>().norm();
  }

  [[nodiscard]] WindowOffset summarise(const Motion& motion) const {
    constexpr double kRounding = 1.0 / 12 + 1.0 / 12;  // variance of both images' rounding to grey levels
    const double noise = std::max(kRounding, squares_ / weight_);
    return {motion.offset, std::sqrt(noise * inverse_(1, 1)), 1 - squares_ / std::max(variance_, 1e-9)};
  }

 private:
  struct Pixel {
    double weight, grey;
    Vector jacobian;
  };
  static constexpr double kSigma = 4;  // pixels, of the weights
  static constexpr double kMiddleGrey = 128;

  /// Differentiates by four neighbours: exact for polynomials up to the fourth degree.
  static double derivative(int two_before, int before, int after, int two_after) {
    return (8.0 * (after - before) - (two_after - two_before)) / 12.0;
  }

  void factorise(const Matrix& normal) {
    constexpr double kMinDeterminant = 1e-6;  // of the matrix scaled to a diagonal of ones
    const Vector scale = normal.diagonal().cwiseMax(1e-9).cwiseSqrt().cwiseInverse();
    const Eigen::LLT<Matrix> factors(scale.asDiagonal() * normal * scale.asDiagonal());
    const double root = factors.matrixLLT().diagonal().prod();
    textured_ = factors.info() == Eigen::Success && root * root > kMinDeterminant;
    inverse_ = scale.asDiagonal() * factors.solve(Matrix::Identity()) * scale.asDiagonal();
    variance_ = normal(4, 4) - normal(4, 5) * normal(4, 5) / weight_;
  }

  int u_, v_;
  std::array<Pixel, kSide * kSide> pixels_;
  std::size_t next_ = 0;
  Matrix inverse_;
  double weight_ = 0, squares_ = 0, variance_ = 0;
  bool textured_ = false;
};

}  // namespace

std::optional<WindowOffset> measure_offset(const GrayImage& first, const GrayImage& other,
                                           const Eigen::Vector2d& pixel, const Eigen::Vector2d& guess,
                                           double reach_px) {
  require(first.width() == other.width() && first.height() == other.height(), "both images have one size");
  if (!pixel.allFinite() || !guess.allFinite()) return std::nullopt;
  const int u = static_cast<int>(std::lround(pixel.x())), v = static_cast<int>(std::lround(pixel.y()));
  if (!has_room(first, u, v, kHalf + 2)) return std::nullopt;
  OffsetWindow window(first, u, v);
  if (!window.textured()) return std::nullopt;
  constexpr int kMaxSteps = 15;
  constexpr double kSettled = 0.005;  // pixels
  constexpr double kMaxSlope = 1;     // pixels a pixel: steeper surfaces look different in the two images
  Motion motion{guess};
  for (int step = 0; step < kMaxSteps; ++step) {
    const auto length = window.step(other, motion);
    const bool within = (motion.offset - guess).norm() <= reach_px && std::abs(motion.slope_u) <= kMaxSlope &&
                        std::abs(motion.slope_v) <= kMaxSlope;
    if (!length || !within) return std::nullopt;
    if (*length < kSettled) return window.summarise(motion);
  }
  return std::nullopt;
}

}  // namespace cairn
