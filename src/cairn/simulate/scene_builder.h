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

/// Paints one surface; what it draws depends on nothing but the two arguments.
using Painter = std::function<void(Canvas&, Random&)>;

/// A box on four vertical sides, turned by `yaw` about its vertical axis.
struct Box {
  Eigen::Vector3d bottom{0, 0, 0};  ///< centre of its lower face, metres
  Eigen::Vector3d size{1, 1, 1};    ///< along its own x, y, z before it is turned, metres
  double yaw = 0;                   ///< radians, about z
};

/// Collects the surfaces of a scene whose z axis is up, then paints all of them in parallel. Each surface
/// draws from a random stream of its own.
class SceneBuilder {
 public:
  /// `texel`: side of a texture's pixel in metres.
  SceneBuilder(double texel, std::uint64_t seed) : texel_(texel), seed_(seed) {}

  /// An upright rectangle that faces along `normal` (horizontal, unit); `bottom` is the middle of its lower
  /// side.
  void add_wall(const Eigen::Vector3d& bottom, const Eigen::Vector3d& normal, double width, double height,
                const Painter& paint);
  /// A level rectangle with sides along x and y turned by `yaw`, seen from above or from below.
  void add_floor(const Eigen::Vector3d& center, double size_x, double size_y, double yaw,
                 const Painter& paint);
  void add_ceiling(const Eigen::Vector3d& center, double size_x, double size_y, double yaw,
                   const Painter& paint);
  /// Sides and top, and the lower face too where the box does not stand on the ground.
  void add_box(const Box& box, const Painter& paint) { add_box(box, paint, paint); }
  void add_box(const Box& box, const Painter& paint_sides, const Painter& paint_top);

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
