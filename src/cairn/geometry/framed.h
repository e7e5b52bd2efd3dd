// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cairn/geometry/rigid3.h"

namespace cairn {

/// Names the frames in the types of transforms: the kind of a frame, not which one. The worlds of two runs
/// have one name.
namespace frame {
struct World;
struct Camera;
struct Left;   ///< left camera of a stereo pair, as it is recorded
struct Right;  ///< right camera of a stereo pair, as it is recorded
struct ViewA;  ///< camera of the first of two views
struct ViewB;  ///< camera of the second of two views
}  // namespace frame

/// Describes a Rigid3 whose type names its frames: point_in_to = to_from * point_in_from. It composes only if
/// the inner frames agree. A Rigid3 becomes a Transform by an explicit conversion; a Transform is accepted as
/// a Rigid3 by solvers that do not depend on frames.
template <class To, class From>
struct Transform : Rigid3 {
  Transform() = default;
  explicit Transform(const Rigid3& to_from) : Rigid3(to_from) {}
  template <class OtherTo, class OtherFrom>
  explicit Transform(const Transform<OtherTo, OtherFrom>& other_frames) = delete;

  [[nodiscard]] Transform<From, To> inverse() const { return Transform<From, To>(Rigid3::inverse()); }
};

/// Composes two transforms that share the inner frame B.
template <class A, class B, class C>
[[nodiscard]] Transform<A, C> operator*(const Transform<A, B>& a_from_b, const Transform<B, C>& b_from_c) {
  return Transform<A, C>(static_cast<const Rigid3&>(a_from_b) * static_cast<const Rigid3&>(b_from_c));
}
/// Deleted, because the inner frames differ and the product of two Rigid3 would be taken instead.
template <class A, class B, class C, class D>
void operator*(const Transform<A, B>& a_from_b, const Transform<C, D>& c_from_d) = delete;

/// Perturbs a transform on the left; its frames stay.
template <class To, class From>
[[nodiscard]] Transform<To, From> perturb_left(const Vector6d& xi, const Transform<To, From>& to_from) {
  return Transform<To, From>(perturb_left(xi, static_cast<const Rigid3&>(to_from)));
}

using CameraFromWorld = Transform<frame::Camera, frame::World>;
using WorldFromCamera = Transform<frame::World, frame::Camera>;

}  // namespace cairn
