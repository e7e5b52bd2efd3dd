// SPDX-License-Identifier: Apache-2.0
#include "cairn/simulate/camera_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cairn/core/error.h"

namespace cairn {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

/// sin of `periods` whole periods over the way.
double wave(double share, int periods, double phase) {
  return std::sin(kTurn * periods * share + phase);
}

/// The heading's turn, 0 to 1, over a corner: C2 at both ends.
double smoother_step(double t) {
  return t * t * t * (t * (6 * t - 15) + 10);
}

/// Where in the round a distance lies: which corner comes next or is being driven, how far into it.
struct CornerPlace {
  int corners_behind = 0;
  double into_corner = 0;  ///< 0 to 1; 0 on a straight
};

CornerPlace corner_place(double distance, double straight_x, double straight_y, double corner) {
  CornerPlace place;
  distance -= straight_x / 2;  // the round begins in the middle of a long side
  for (int i = 0; i < 4 && distance > 0; ++i) {
    if (distance < corner) {
      place.into_corner = distance / corner;
      return place;
    }
    distance -= corner + (i % 2 == 0 ? straight_y : straight_x);
    ++place.corners_behind;
  }
  return place;
}

}  // namespace

Eigen::Quaterniond world_from_looking(double azimuth, double elevation, double roll) {
  const double ca = std::cos(azimuth), sa = std::sin(azimuth);
  const double ce = std::cos(elevation), se = std::sin(elevation);
  Eigen::Matrix3d axes;
  axes.col(0) = Eigen::Vector3d(sa, -ca, 0);
  axes.col(2) = Eigen::Vector3d(ca * ce, sa * ce, se);
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return (Eigen::Quaterniond(axes) * Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitZ())).normalized();
}

RoomPath::RoomPath(const Shape& shape) : shape_(shape) {
  require(shape.loops >= 1 && shape.length > 0 && shape.duration > 0, "a walk has a length");
  radius_ = std::min(shape.length / (kTurn * shape.loops), shape.max_radius);
  constexpr double kStepsPerSecond = 1.7;
  steps_ = std::max(1, static_cast<int>(std::lround(kStepsPerSecond * shape.duration)));
}

WorldFromCamera RoomPath::world_from_camera(double share) const {
  const int loops = shape_.loops;
  const double around = kTurn * loops * share;
  const double radius = radius_ * (1 + 0.1 * wave(share, 3 * loops, 0.4) + 0.1 * wave(share, 1, 2.0));
  const double bob = wave(share, steps_, 0), sway = wave(share, std::max(1, steps_ / 2), 1.0);
  WorldFromCamera pose;
  pose.translation =
      shape_.center + Eigen::Vector3d(1.1 * radius * std::cos(around), 0.9 * radius * std::sin(around),
                                      0.06 * wave(share, 2 * loops + 1, 1.3) + 0.006 * bob);
  const double azimuth = around + 0.5 + 0.22 * wave(share, 2 * loops + 1, 0.7) + 0.003 * sway;
  const double elevation = -0.17 + 0.10 * wave(share, 3 * loops + 1, 2.1) + 0.004 * bob;
  const double roll = 0.05 * wave(share, 2 * loops + 1, 4.0) + 0.004 * sway;
  pose.rotation = world_from_looking(azimuth, elevation, roll);
  return pose;
}

StreetPath::StreetPath(const Shape& shape) : shape_(shape) {
  const double straights = shape.length / 2 - 2 * shape.corner_length;  // one long and one short one
  require(straights > 0, "a street has straights between its corners");
  const double straight_y = straights / (1 + shape.aspect), straight_x = straights - straight_y;
  const auto steps = static_cast<std::size_t>(std::ceil(shape.length / 0.01));
  const double step = shape.length / static_cast<double>(steps);
  points_.resize(steps + 1);
  times_.resize(steps + 1);
  for (std::size_t i = 0; i < steps; ++i) {
    const CornerPlace middle =
        corner_place((static_cast<double>(i) + 0.5) * step, straight_x, straight_y, shape.corner_length);
    const double heading = kTurn / 4 * (middle.corners_behind + smoother_step(middle.into_corner));
    const double slow = std::sin(std::numbers::pi * middle.into_corner);
    const double speed = 1 - (1 - shape.corner_speed) * slow * slow;
    points_[i + 1].position =
        points_[i].position + step * Eigen::Vector2d(std::cos(heading), std::sin(heading));
    times_[i + 1] = times_[i] + step / speed;
  }
  for (std::size_t i = 0; i <= steps; ++i) {
    const CornerPlace here =
        corner_place(static_cast<double>(i) * step, straight_x, straight_y, shape.corner_length);
    points_[i].heading = kTurn / 4 * (here.corners_behind + smoother_step(here.into_corner));
    times_[i] /= times_.back();
  }
  start_of_straight_ = times_[steps - static_cast<std::size_t>(std::floor(straight_x / 2 / step))];
  const double half_y =
      points_[steps / 2].position.y() / 2;  // it begins at (0, 0), in the lower side's middle
  half_extent_ = {0, half_y};
  for (PathPoint& place : points_) {
    place.position.y() -= half_y;
    half_extent_.x() = std::max(half_extent_.x(), place.position.x());
  }
}

StreetPath::PathPoint StreetPath::at(double share) const {
  require(share >= 0 && share <= 1, "a share is in [0, 1]");
  const auto after = std::upper_bound(times_.begin() + 1, times_.end() - 1, share);
  const auto i = static_cast<std::size_t>(after - times_.begin());
  const double t = (share - times_[i - 1]) / (times_[i] - times_[i - 1]);
  const PathPoint &a = points_[i - 1], &b = points_[i];
  return {a.position + t * (b.position - a.position), a.heading + t * (b.heading - a.heading)};
}

}  // namespace cairn
