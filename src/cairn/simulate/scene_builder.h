// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "cairn/core/executor.h"
#include "cairn/core/random.h"
#include "cairn/simulate/canvas.h"
#include "cairn/simulate/scene.h"

namespace cairn {

/// Paints one surface; the result depends only on the two arguments.
using Painter = std::function<void(Canvas&, Random&)>;

/// Describes a box with four vertical sides, rotated by `yaw` about its vertical axis.
struct Box {
  Eigen::Vector3d bottom{0, 0, 0};  ///< centre of its lower face, metres
  Eigen::Vector3d size{1, 1, 1};    ///< along its own x, y, z before it is rotated, metres
  double yaw = 0;                   ///< radians, about z
};

/// Collects the surfaces of a scene whose z axis is up, then paints all of them in parallel. Each surface
/// draws from a random stream of its own.
class SceneBuilder {
 public:
  /// Begins a scene; `texel` is the side of a texture's pixel in metres.
  SceneBuilder(double texel, std::uint64_t seed) : texel_(texel), seed_(seed) {}

  /// Adds an upright rectangle that faces along `normal` (horizontal, unit); `bottom` is the middle of its
  /// lower side.
  void add_wall(const Eigen::Vector3d& bottom, const Eigen::Vector3d& normal, double width, double height,
                const Painter& paint);
  /// Adds a level rectangle with sides along x and y rotated by `yaw`, seen from above.
  void add_floor(const Eigen::Vector3d& center, double size_x, double size_y, double yaw,
                 const Painter& paint);
  /// Adds a level rectangle with sides along x and y rotated by `yaw`, seen from below.
  void add_ceiling(const Eigen::Vector3d& center, double size_x, double size_y, double yaw,
                   const Painter& paint);
  /// Adds sides and top, and the lower face too if the box does not stand on the ground.
  void add_box(const Box& box, const Painter& paint) { add_box(box, paint, paint); }
  /// Adds a box whose sides and other faces are painted differently.
  void add_box(const Box& box, const Painter& paint_sides, const Painter& paint_top);

  /// Paints all surfaces in parallel and returns the scene.
  [[nodiscard]] Scene build(const Executor& executor) const;

 private:
  void add(const Surface& surface, float brightness, const Painter& paint);

  struct Job {
    Surface surface;
    float brightness;
    Painter paint;
  };
  double texel_;
  std::uint64_t seed_;
  std::vector<Job> jobs_;
};

}  // namespace cairn
