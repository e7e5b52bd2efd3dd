// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cairn/core/executor.h"
#include "cairn/features/aligned_floats.h"
#include "cairn/features/sift_rows.h"
#include "cairn/image/image.h"

namespace cairn {

/// Smoothing of the first level of each octave, in that octave's pixels (Lowe 2004, section 3.3).
constexpr double kSiftSigma = 1.6;

/// Holds Lowe's scale space: octaves of an image, each of `layers` + 3 levels, each level smoother than the
/// one before by the factor 2^(1 / layers). The first octave is the image doubled, each other one half of the
/// octave before. Pixel (x, y) of octave o lies at (x, y) * pixel_size(o) of the image, without an offset:
/// the doubling interpolates between pixels, the halving takes every second one.
///
/// The two coarsest levels of an octave are levels 1 and 2 of the next, which has enough pixels for both; so
/// only the last octave holds all, and OctaveRows makes the others when they are needed.
///
/// D. G. Lowe, "Distinctive Image Features from Scale-Invariant Keypoints", IJCV 60(2), 2004, section 3.
class ScaleSpace {
 public:
  /// Allocates memory for images of this size: about 21 bytes * width * height * (layers + 1). layers >= 1.
  ScaleSpace(int width, int height, int layers);

  /// Computes all levels from `image`, which has the size given to the constructor. Grey values stay 0 to
  /// 255.
  void build(const GrayImage& image, const Executor& executor);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] int layers() const { return layers_; }
  /// Returns the number of octaves; 0 if the image is too small for one.
  [[nodiscard]] int octave_count() const { return static_cast<int>(octaves_.size()); }
  /// Returns the number of levels that an octave holds: layers + 1 but at least 3, the last octave layers +
  /// 3.
  [[nodiscard]] int level_count(int octave) const {
    return static_cast<int>(octaves_[static_cast<std::size_t>(octave)].size());
  }
  /// Returns a level of an octave, in [0, level_count).
  [[nodiscard]] const ScaleLevel& level(int octave, int level) const {
    return octaves_[static_cast<std::size_t>(octave)][static_cast<std::size_t>(level)];
  }
  /// Returns the smoothing of a level, which may lie between two, in pixels of its octave.
  [[nodiscard]] double sigma(double level) const;
  /// Returns the image pixels per pixel of the octave.
  [[nodiscard]] static double pixel_size(int octave);

 private:
  using Octave = std::vector<ScaleLevel>;

  int width_, height_, layers_;
  std::vector<std::vector<float>> blurs_;  ///< weights that make level i + 1 of level i
  std::vector<Octave> octaves_;
  AlignedFloats memory_;
};

/// Holds some rows of all `layers` + 3 levels of an octave. The scale space must outlive it.
class OctaveRows {
 public:
  /// Takes rows [begin, end) of those that the octave has.
  OctaveRows(const ScaleSpace& space, int octave, int begin, int end);
  [[nodiscard]] const float* row(int level, int y) const {
    const ScaleLevel& rows = levels_[static_cast<std::size_t>(level)];
    return rows.row(y - begin_);
  }
  [[nodiscard]] int begin() const { return begin_; }
  [[nodiscard]] int end() const { return end_; }

 private:
  int begin_, end_;
  AlignedFloats made_;
  std::vector<ScaleLevel> levels_;  ///< from row `begin` on
};

}  // namespace cairn
