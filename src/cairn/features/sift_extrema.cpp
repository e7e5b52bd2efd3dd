// SPDX-License-Identifier: Apache-2.0
#include "cairn/features/sift_extrema.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>

#include "cairn/features/kernels/extrema_kernels.h"

namespace cairn {
namespace {

constexpr int kBorder = 5;    // octave pixels: nearer to the border, D is made of repeated pixels
constexpr int kMaxMoves = 5;  // from pixel to pixel towards the extremum
constexpr int kReach = 2;     // pixels on either side: an extremum farther off is found from elsewhere
constexpr double kGreyRange = 255;
// Of the contrast, at a pixel: between pixels and levels the parabola may reach the whole.
constexpr double kFirstShare = 0.8;
constexpr int kRowsAhead = 3;    // that are asked for before their turn
constexpr int kCacheLine = 16;   // floats
constexpr int kSecondCache = 2;  // __builtin_prefetch's name for it

struct GridPosition {
  int x, y, level;
};

struct Vector3 {
  double x, y, s;
};

/// Gradient and second derivatives of D by differences of neighbours.
struct Derivatives {
  Vector3 gradient;
  double xx, yy, ss, xy, xs, ys;
};

/// D(x, y, level) = G(level + 1) - G(level).
double difference(const OctaveRows& rows, int x, int y, int level) {
  return static_cast<double>(rows.row(level + 1, y)[x] - rows.row(level, y)[x]);
}

Derivatives derivatives_at(const OctaveRows& rows, const GridPosition& at) {
  const auto d = [&](int dx, int dy, int ds) {
    return difference(rows, at.x + dx, at.y + dy, at.level + ds);
  };
  const double centre2 = 2 * d(0, 0, 0);
  const double left = d(-1, 0, 0), right = d(1, 0, 0), up = d(0, -1, 0), down = d(0, 1, 0);
  const double finer = d(0, 0, -1), coarser = d(0, 0, 1);
  return {{(right - left) / 2, (down - up) / 2, (coarser - finer) / 2},
          right + left - centre2,
          down + up - centre2,
          coarser + finer - centre2,
          (d(1, 1, 0) - d(-1, 1, 0) - d(1, -1, 0) + d(-1, -1, 0)) / 4,
          (d(1, 0, 1) - d(-1, 0, 1) - d(1, 0, -1) + d(-1, 0, -1)) / 4,
          (d(0, 1, 1) - d(0, -1, 1) - d(0, 1, -1) + d(0, -1, -1)) / 4};
}

/// -H^-1 g by Cramer's rule (Lowe 2004, equation 3); nothing where H is singular.
std::optional<Vector3> parabola_offset(const Derivatives& D) {
  const double a = D.yy * D.ss - D.ys * D.ys, b = D.xs * D.ys - D.xy * D.ss, c = D.xy * D.ys - D.xs * D.yy;
  const double determinant = D.xx * a + D.xy * b + D.xs * c;
  if (determinant == 0) return std::nullopt;
  const double d = D.xx * D.ss - D.xs * D.xs, e = D.xy * D.xs - D.xx * D.ys, f = D.xx * D.yy - D.xy * D.xy;
  const Vector3& g = D.gradient;
  return Vector3{-(a * g.x + b * g.y + c * g.s) / determinant, -(b * g.x + d * g.y + e * g.s) / determinant,
                 -(c * g.x + e * g.y + f * g.s) / determinant};
}

/// Ratio of the principal curvatures below r: trace^2 / determinant < (r + 1)^2 / r (section 4.1).
bool is_corner(const Derivatives& D, double ratio) {
  const double trace = D.xx + D.yy, determinant = D.xx * D.yy - D.xy * D.xy;
  return determinant > 0 && trace * trace * ratio < (ratio + 1) * (ratio + 1) * determinant;
}

/// Rows [begin, end) of an octave, at least kBorder away from its border.
struct Strip {
  int octave, begin, end;
};

class StripSearch {
 public:
  StripSearch(const ScaleSpace& space, const SiftExtremaOptions& options, const Strip& strip)
      : strip_(strip),
        width_(space.level(strip.octave, 0).width),
        layers_(space.layers()),
        threshold_(options.contrast / space.layers() * kGreyRange),
        edge_ratio_(options.edge_ratio),
        rows_(space, strip.octave, strip.begin - kReach - 1, strip.end + kReach + 1),
        found_(static_cast<std::size_t>(width_)) {}

  std::vector<ScalePoint> search() {
    for (int y = strip_.begin; y < strip_.end; ++y) {
      prefetch(y + kRowsAhead);
      for (int level = 1; level <= layers_; ++level) search_row(y, level);
    }
    return std::move(points_);
  }

 private:
  /// There are more rows to read side by side than the processor foresees.
  void prefetch(int y) const {
    if (y >= rows_.end()) return;
    for (int level = 0; level < layers_ + 3; ++level)
      for (int x = 0; x < width_; x += kCacheLine)
        __builtin_prefetch(rows_.row(level, y) + x, 0, kSecondCache);
  }

  void search_row(int y, int level) {
    GaussianRows rows{};
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 3; ++j) rows.rows[i][j] = rows_.row(level - 1 + i, y - 1 + j);
    const int count = extrema_kernels().find(rows, kBorder, width_ - kBorder,
                                             static_cast<float>(kFirstShare * threshold_), found_.data());
    for (int i = 0; i < count; ++i) {
      const auto point = refine({found_[static_cast<std::size_t>(i)], y, level});
      if (point) points_.push_back(*point);
    }
  }

  /// Moves to the pixel and level nearest to the parabola's extremum until it stays.
  [[nodiscard]] std::optional<ScalePoint> refine(const GridPosition& start) const {
    GridPosition at = start;
    for (int move = 0; move < kMaxMoves; ++move) {
      const Derivatives derivatives = derivatives_at(rows_, at);
      const auto offset = parabola_offset(derivatives);
      if (!offset) return std::nullopt;
      constexpr double kHalf = 0.5;
      if (std::abs(offset->x) <= kHalf && std::abs(offset->y) <= kHalf && std::abs(offset->s) <= kHalf)
        return accept(at, derivatives, *offset);
      if (std::abs(offset->x) > kReach + 1 || std::abs(offset->y) > kReach + 1 ||
          std::abs(offset->s) > layers_)
        return std::nullopt;
      at.x += static_cast<int>(std::lround(offset->x));
      at.y += static_cast<int>(std::lround(offset->y));
      at.level += static_cast<int>(std::lround(offset->s));
      if (!is_near(at, start)) return std::nullopt;
    }
    return std::nullopt;
  }

  [[nodiscard]] bool is_near(const GridPosition& at, const GridPosition& start) const {
    return std::abs(at.x - start.x) <= kReach && std::abs(at.y - start.y) <= kReach && at.level >= 1 &&
           at.level <= layers_;
  }

  [[nodiscard]] std::optional<ScalePoint> accept(const GridPosition& at, const Derivatives& derivatives,
                                                 const Vector3& offset) const {
    const Vector3& g = derivatives.gradient;
    const double value =
        difference(rows_, at.x, at.y, at.level) + (g.x * offset.x + g.y * offset.y + g.s * offset.s) / 2;
    if (std::abs(value) < threshold_ || !is_corner(derivatives, edge_ratio_)) return std::nullopt;
    return ScalePoint{strip_.octave, static_cast<float>(at.x + offset.x), static_cast<float>(at.y + offset.y),
                      static_cast<float>(at.level + offset.s), static_cast<float>(std::abs(value))};
  }

  Strip strip_;
  int width_, layers_;
  double threshold_, edge_ratio_;
  OctaveRows rows_;
  std::vector<int> found_;
  std::vector<ScalePoint> points_;
};

std::vector<Strip> strips_of(const ScaleSpace& space) {
  std::vector<Strip> strips;
  for (int octave = 0; octave < space.octave_count(); ++octave) {
    const int end = space.level(octave, 0).height - kBorder;
    for (int begin = kBorder; begin < end; begin += kStripRows)
      strips.push_back({octave, begin, std::min(end, begin + kStripRows)});
  }
  return strips;
}

bool is_before(const ScalePoint& a, const ScalePoint& b) {
  return std::tie(b.response, a.octave, a.y, a.x, a.level) <
         std::tie(a.response, b.octave, b.y, b.x, b.level);
}

bool is_same(const ScalePoint& a, const ScalePoint& b) {
  return std::tie(a.octave, a.y, a.x, a.level) == std::tie(b.octave, b.y, b.x, b.level);
}

}  // namespace

std::vector<ScalePoint> find_sift_extrema(const ScaleSpace& space, const SiftExtremaOptions& options,
                                          const Executor& executor) {
  const std::vector<Strip> strips = strips_of(space);
  const auto found = executor.map<std::vector<ScalePoint>>(
      strips.size(), [&](std::size_t i) { return StripSearch(space, options, strips[i]).search(); });
  std::vector<ScalePoint> points;
  for (const auto& part : found) points.insert(points.end(), part.begin(), part.end());
  std::sort(points.begin(), points.end(), is_before);
  points.erase(std::unique(points.begin(), points.end(), is_same),
               points.end());  // two pixels may lead to one
  return points;
}

}  // namespace cairn
