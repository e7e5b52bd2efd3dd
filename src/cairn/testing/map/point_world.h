// SPDX-License-Identifier: Apache-2.0
// A world of points for tests of tracking and mapping.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "cairn/map/map.h"
#include "cairn/testing/geometry/camera_paths.h"
#include "cairn/testing/geometry/random_points.h"

namespace cairn::testkit {

inline constexpr SimulatedCamera kWorldCamera{{525, 525, 319.5, 239.5, 0.075}, 640, 480};
inline constexpr Rig kWorldRig = kWorldCamera.rig;

/// Describes a point of the world. Points of one look have one descriptor; frames before the first and after
/// the last do not see it.
struct WorldPoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  std::uint64_t look = 0;
  std::int32_t first_frame = 0, last_frame = std::numeric_limits<std::int32_t>::max();
};

/// Holds what a camera sees; feature i shows point points[i] of the world.
struct View {
  ObservedFrame observed;
  std::vector<std::size_t> points;
};

/// Holds points, each with its look, that kWorldCamera sees.
struct PointWorld {
  std::vector<WorldPoint> points;
  double noise_px = 0;  ///< of u and v; d has a tenth of it

  /// Adds a point with a look of its own.
  void add(const Eigen::Vector3d& position) { points.push_back({position, points.size(), 0}); }
  /// Returns what the camera sees of the points 0.3 m or more ahead.
  [[nodiscard]] View see(const Rigid3& world_from_camera, std::int32_t frame) const;
};

/// Returns points 2 to 5 m before a camera in the origin, some of them outside its image.
[[nodiscard]] PointWorld points_ahead(std::size_t count, std::uint64_t seed);

/// Returns features that show nothing in particular.
[[nodiscard]] ObservedFrame blank_frame(std::size_t features, std::int32_t frame = 0);

}  // namespace cairn::testkit
