// SPDX-License-Identifier: Apache-2.0
#include "cairn/testing/map/point_world.h"

#include <utility>

#include "cairn/core/random.h"
#include "cairn/testing/features/random_descriptor.h"

namespace cairn::testkit {

namespace {

void add_feature(const Observation& seen, double depth, ObservedFrame& observed) {
  constexpr double kPatch = 60;  // pixels * metres
  observed.observations.push_back(seen);
  observed.points_in_camera.push_back(kWorldRig.point_at(seen.u, seen.v, kWorldRig.depth(seen.d)));
  observed.features.keypoints.push_back(
      {static_cast<float>(seen.u), static_cast<float>(seen.v), static_cast<float>(kPatch / depth)});
}

}  // namespace

View PointWorld::see(const Rigid3& world_from_camera, std::int32_t frame) const {
  constexpr double kNearest = 0.3;  // metres
  View view;
  view.observed.frame = {frame};
  view.observed.stamp_ns = frame * 33'000'000LL;
  Random random(7, static_cast<std::uint64_t>(frame));
  const Rigid3 camera_from_world = world_from_camera.inverse();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d point = camera_from_world * points[i].position;
    const bool shows_itself = points[i].first_frame <= frame && frame <= points[i].last_frame;
    if (!shows_itself || point.z() < kNearest) continue;
    const Observation seen = observe(random, kWorldRig.project(point), {1, 0.1, noise_px});
    if (!kWorldCamera.shows({seen.u, seen.v, seen.d})) continue;
    view.points.push_back(i);
    add_feature(seen, point.z(), view.observed);
  }
  auto& descriptors = view.observed.features.descriptors = Descriptors(Norm::hamming, 32, view.points.size());
  for (std::size_t i = 0; i < view.points.size(); ++i)
    put_look(99, points[view.points[i]].look, i, descriptors);
  return view;
}

PointWorld points_ahead(std::size_t count, std::uint64_t seed) {
  PointWorld world;
  Random random(seed);
  for (const Eigen::Vector3d& point : points_in_box(random, count, {-3, -2, 2}, {3, 2, 5})) world.add(point);
  return world;
}

ObservedFrame blank_frame(std::size_t features, std::int32_t frame) {
  ObservedFrame observed;
  observed.frame = {frame};
  observed.observations.resize(features);
  observed.features.keypoints.resize(features);
  observed.features.descriptors = Descriptors(Norm::hamming, 32, features);
  observed.points_in_camera.assign(features,
                                   Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN()));
  return observed;
}

}  // namespace cairn::testkit
