// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "cairn/geometry/framed.h"

namespace cairn {

/// Computes a camera's orientation from where it looks: `azimuth` about z from x, `elevation` above the
/// horizon, `roll` about the optical axis (clockwise as the viewer sees the camera rotate), all radians; z is
/// up.
[[nodiscard]] Eigen::Quaterniond world_from_looking(double azimuth, double elevation, double roll);

/// Describes a closed walk about the middle of a room with a hand-held camera that looks outwards, about and
/// a little down, and bobs with the steps. Smooth in every derivative: sums of sines with whole periods.
class RoomPath {
 public:
  /// Sets the walk.
  struct Shape {
    Eigen::Vector3d center{0, 0, 1.35};  ///< metres; z is the camera's mean height
    double length = 4.0;                 ///< metres to walk in all loops together
    double duration = 10.0;              ///< seconds, for the rhythm of the steps
    int loops = 1;
    double max_radius = 1.2;  ///< metres, mean of the largest loop; a longer walk is slower
  };

  explicit RoomPath(const Shape& shape);
  /// Returns the pose after `share` of the walk, in [0, 1); at 1 it is back at the start.
  [[nodiscard]] WorldFromCamera world_from_camera(double share) const;

 private:
  Shape shape_;
  double radius_;
  int steps_;
};

/// Describes a closed drive around a block: a rounded rectangle whose corners are entered and left gently
/// (the heading is a smooth step of the distance), slower in the corners. Level, in the plane of x and y,
/// anticlockwise.
class StreetPath {
 public:
  /// Sets the drive.
  struct Shape {
    double length = 160;        ///< metres, once around
    double aspect = 1.25;       ///< straights of the long sides over those of the short sides
    double corner_length = 24;  ///< metres driven in a corner
    double corner_speed = 0.7;  ///< speed in the middle of a corner over that on a straight
  };
  /// Holds position and heading at one time.
  struct PathPoint {
    Eigen::Vector2d position{0, 0};  ///< metres; the block's middle is (0, 0)
    double heading = 0;              ///< radians about z from x
  };

  explicit StreetPath(const Shape& shape);
  /// Returns the point after `share` of the time of one round, in [0, 1].
  [[nodiscard]] PathPoint at(double share) const;
  /// Returns the share at which the long straight begins in whose middle the round begins.
  [[nodiscard]] double start_of_straight() const { return start_of_straight_; }
  /// Returns half of the block's extent in x and y, to the middle of the road, metres.
  [[nodiscard]] const Eigen::Vector2d& half_extent() const { return half_extent_; }

 private:
  Shape shape_;
  Eigen::Vector2d half_extent_;
  double start_of_straight_ = 0;
  std::vector<PathPoint> points_;  // at equal steps of the way
  std::vector<double> times_;      // when each is reached, last = 1
};

}  // namespace cairn
