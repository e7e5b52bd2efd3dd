// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cairn/geometry/rigid3.h"

namespace cairn {

/// Names of frames for the types of transforms. They say the kind of a frame, not which one: the worlds of
/// two runs have one name.
namespace frame {
struct World;
struct Camera;
struct Left;   ///< left camera of a stereo pair, as it is recorded
struct Right;  ///< right camera of a stereo pair, as it is recorded
struct ViewA;  ///< camera of the first of two views
struct ViewB;  ///< camera of the second of two views
}  // namespace frame

/// A Rigid3 whose type says its frames: point_in_to = to_from * point_in_from. It composes only where the
/// inner frames agree, and stands only where its own frames are asked for. Whoever knows the frames of a
/// Rigid3 says so by converting it; the other way, for solvers to which frames do not matter, needs no word.
template <class To, class From>
struct Transform : Rigid3 {
  Transform() = default;
  explicit Transform(const Rigid3& to_from) : Rigid3(to_from) {}
  template <class OtherTo, class OtherFrom>
  explicit Transform(const Transform<OtherTo, OtherFrom>& other_frames) = delete;

  [[nodiscard]] Transform<From, To> inverse() const { return Transform<From, To>(Rigid3::inverse()); }
};

template <class A, class B, class C>
[[nodiscard]] Transform<A, C> operator*(const Transform<A, B>& a_from_b, const Transform<B, C>& b_from_c) {
  return Transform<A, C>(static_cast<const Rigid3&>(a_from_b) * static_cast<const Rigid3&>(b_from_c));
}
/// The inner frames differ. Deleted, because the product of two Rigid3 would take it.
template <class A, class B, class C, class D>
void operator*(const Transform<A, B>& a_from_b, const Transform<C, D>& c_from_d) = delete;

/// A perturbation of a transform leaves its frames.
template <class To, class From>
[[nodiscard]] Transform<To, From> perturb_left(const Vector6d& xi, const Transform<To, From>& to_from) {
  return Transform<To, From>(perturb_left(xi, static_cast<const Rigid3&>(to_from)));
}

using CameraFromWorld = Transform<frame::Camera, frame::World>;
using WorldFromCamera = Transform<frame::World, frame::Camera>;

}  // namespace cairn
