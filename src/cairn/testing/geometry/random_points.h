// SPDX-License-Identifier: Apache-2.0
// What simulated scenes are made of: points, cameras that see some of them, noise and wrong matches. All of
// it draws from a stream of random numbers in the order that is written here, whatever the compiler.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "cairn/core/random.h"
#include "cairn/geometry/rig.h"
#include "cairn/geometry/rigid3.h"

namespace cairn::testkit {

/// Returns a vector whose elements are normal with mean 0 and standard deviation `sigma`.
[[nodiscard]] Eigen::Vector3d normal_vector(Random& random, double sigma = 1);

/// Returns a point that is uniform in the box from `low` to `high`.
[[nodiscard]] Eigen::Vector3d point_in_box(Random& random, const Eigen::Vector3d& low,
                                           const Eigen::Vector3d& high);

/// Returns `count` points that are uniform in the box from `low` to `high`.
[[nodiscard]] std::vector<Eigen::Vector3d> points_in_box(Random& random, std::size_t count,
                                                         const Eigen::Vector3d& low,
                                                         const Eigen::Vector3d& high);

/// Returns a motion whose rotation vector has the standard deviation `radians`, its translation `metres`.
[[nodiscard]] Rigid3 small_motion(Random& random, double radians, double metres);

/// Holds a stereo camera and the size of its images, in pixels.
struct SimulatedCamera {
  Rig rig;
  int width = 640, height = 480;

  /// Returns whether the pixel (u, v) of `pixels` lies between the centres of the outermost pixels.
  [[nodiscard]] bool shows(const Eigen::Vector3d& pixels) const;
  /// Returns a point in the camera's frame that is uniform in column, row and depth, which is `nearest` to
  /// `farthest` metres.
  [[nodiscard]] Eigen::Vector3d point_in_view(Random& random, double nearest, double farthest) const;
};

/// Describes the noise of an observation, in pixels.
struct PixelNoise {
  double sigma_px = 1, sigma_d_px = 1;  ///< standard deviations that are stated
  double scale = 1;                     ///< times these, those of the noise; 0 for exact pixels
};

/// Returns (u, v, d) of `exact` with noise. Draws u, v and, if `with_disparity` is set, d; else d is NaN.
[[nodiscard]] Observation observe(Random& random, const Eigen::Vector3d& exact, const PixelNoise& noise,
                                  bool with_disparity = true);

/// Removes the disparity of `seen`.
void forget_disparity(Observation& seen);

/// Makes `seen` a wrong match: one to three times `aside_px` away in any direction, at a disparity between 1
/// and 60 pixels if it has one.
void mislead(Random& random, double aside_px, Observation& seen);

}  // namespace cairn::testkit
