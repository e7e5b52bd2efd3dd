// SPDX-License-Identifier: Apache-2.0
#include "cairn/geometry/framed.h"

#include <gtest/gtest.h>

#include <concepts>

namespace cairn {
namespace {

using RightFromLeft = Transform<frame::Right, frame::Left>;

template <class A, class B>
constexpr bool kComposes = requires(const A& a, const B& b) {
  a* b;
};

// what frames allow for, and that a product and an inverse have the frames that they should
static_assert(kComposes<CameraFromWorld, WorldFromCamera>);
static_assert(kComposes<CameraFromWorld, Rigid3> && kComposes<Rigid3, CameraFromWorld>);
static_assert(std::same_as<decltype(CameraFromWorld{} * Transform<frame::World, frame::Left>{}),
                           Transform<frame::Camera, frame::Left>>);
static_assert(std::same_as<decltype(CameraFromWorld{}.inverse()), WorldFromCamera>);
static_assert(std::same_as<decltype(perturb_left(Vector6d{}, CameraFromWorld{})), CameraFromWorld>);
static_assert(std::convertible_to<CameraFromWorld, Rigid3>);
static_assert(std::copyable<CameraFromWorld>);

// and what they do not
static_assert(!kComposes<CameraFromWorld, CameraFromWorld>);
static_assert(!kComposes<WorldFromCamera, RightFromLeft>);
static_assert(!std::convertible_to<WorldFromCamera, CameraFromWorld>);
static_assert(!std::constructible_from<CameraFromWorld, WorldFromCamera>);
static_assert(!std::assignable_from<CameraFromWorld&, WorldFromCamera>);
static_assert(!std::convertible_to<Rigid3, CameraFromWorld> &&
              !std::assignable_from<CameraFromWorld&, Rigid3>);

const Rigid3 kPlain{rotation_exp({0.3, -0.2, 0.9}), {1, -2, 3}};
const Rigid3 kOther{rotation_exp({-1.3, 0.1, 0.4}), {5, 0.5, -1}};
const Eigen::Vector3d kPoint(0.2, 0.7, 4);

TEST(Transform, computes_as_rigid3_does) {
  const CameraFromWorld camera_from_world(kPlain);
  const Transform<frame::World, frame::Left> world_from_left(kOther);
  EXPECT_EQ(camera_from_world * kPoint, kPlain * kPoint);
  EXPECT_EQ(camera_from_world * world_from_left * kPoint, (kPlain * kOther) * kPoint);
  EXPECT_EQ(camera_from_world.inverse() * kPoint, kPlain.inverse() * kPoint);
  const Vector6d xi = Vector6d::Constant(0.1);
  EXPECT_EQ(perturb_left(xi, camera_from_world) * kPoint, perturb_left(xi, kPlain) * kPoint);
}

TEST(Transform, starts_as_the_identity) {
  EXPECT_EQ(CameraFromWorld{} * kPoint, kPoint);
}

}  // namespace
}  // namespace cairn
