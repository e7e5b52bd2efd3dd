// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "cairn/core/random.h"
#include "cairn/slam/indexed_map.h"

namespace cairn::test {

inline constexpr Rig kRig{525, 525, 319.5, 239.5, 0.075};

/// Points of one look have one descriptor. Frames before the first and after the last do not see it.
struct WorldPoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  std::uint64_t look = 0;
  std::int32_t first_frame = 0, last_frame = std::numeric_limits<std::int32_t>::max();
};

/// What a camera sees; feature i shows point points[i] of the world.
struct View {
  ObservedFrame observed;
  std::vector<std::size_t> points;
};

inline void add_descriptor(std::uint64_t look, std::size_t row, Descriptors& descriptors) {
  Random bytes(99, look);
  for (std::size_t b = 0; b < descriptors.bytes(); ++b)
    descriptors.row(row)[b] = static_cast<std::uint8_t>(bytes.index(256));
}

/// Points, each with its look, that cameras of 640 x 480 see.
struct World {
  std::vector<WorldPoint> points;
  double noise_px = 0;  ///< of u and v; d has a tenth of it

  void add(const Eigen::Vector3d& position) { points.push_back({position, points.size()}); }

  [[nodiscard]] View see(const Rigid3& world_from_camera, std::int32_t frame) const {
    constexpr double kNearest = 0.3, kWidth = 640, kHeight = 480, kPatch = 60;  // metres, pixels, pixels * m
    View view;
    view.observed.frame = {frame};
    view.observed.stamp_ns = frame * 33'000'000LL;
    Random random(7, static_cast<std::uint64_t>(frame));
    const Rigid3 camera_from_world = world_from_camera.inverse();
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Eigen::Vector3d point = camera_from_world * points[i].position;
      const bool shows_itself = points[i].first_frame <= frame && frame <= points[i].last_frame;
      if (!shows_itself || point.z() < kNearest) continue;
      const Eigen::Vector3d seen =
          kRig.project(point) +
          noise_px * Eigen::Vector3d(random.normal(), random.normal(), 0.1 * random.normal());
      if (seen.x() < 0 || seen.x() > kWidth - 1 || seen.y() < 0 || seen.y() > kHeight - 1) continue;
      view.points.push_back(i);
      view.observed.observations.push_back({seen.x(), seen.y(), seen.z(), 1, 0.1});
      view.observed.points_in_camera.push_back(kRig.point_at(seen.x(), seen.y(), kRig.depth(seen.z())));
      view.observed.features.keypoints.push_back({static_cast<float>(seen.x()), static_cast<float>(seen.y()),
                                                  static_cast<float>(kPatch / point.z())});
    }
    auto& descriptors = view.observed.features.descriptors =
        Descriptors(Norm::hamming, 32, view.points.size());
    for (std::size_t i = 0; i < view.points.size(); ++i)
      add_descriptor(points[view.points[i]].look, i, descriptors);
    return view;
  }
};

/// Points 2 to 5 m before a camera in the origin, some of them outside its image.
inline World points_ahead(std::size_t count, std::uint64_t seed) {
  World world;
  Random random(seed);
  for (std::size_t i = 0; i < count; ++i)
    world.add({random.uniform(-3, 3), random.uniform(-2, 2), random.uniform(2, 5)});
  return world;
}

/// Looking along z, moved aside.
inline Rigid3 aside(double x) {
  return {Eigen::Quaterniond::Identity(), {x, 0, 0}};
}

/// Features that show nothing in particular.
inline ObservedFrame blank_frame(std::size_t features, std::int32_t frame = 0) {
  ObservedFrame observed;
  observed.frame = {frame};
  observed.observations.resize(features);
  observed.features.keypoints.resize(features);
  observed.features.descriptors = Descriptors(Norm::hamming, 32, features);
  observed.points_in_camera.assign(features,
                                   Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN()));
  return observed;
}

/// A map as odometry makes it: each keyframe is placed after the one before, and landmarks where the first
/// keyframe that shows them says. A point that `memory` keyframes in a row have not shown becomes another
/// landmark when it is seen again.
struct MapMaker {
  explicit MapMaker(World seen_world, int keyframes_remembered = std::numeric_limits<int>::max())
      : world(std::move(seen_world)), memory(keyframes_remembered), known(world.points.size()) {}

  MapMaker(const MapMaker& other)
      : world(other.world), memory(other.memory), known(other.known), indexed(other.indexed) {}
  MapMaker& operator=(const MapMaker&) = delete;

  KeyframeId add(const Rigid3& truth, const Rigid3& placed) {
    const auto next = static_cast<std::int32_t>(map.keyframes().size());
    View view = world.see(truth, next);
    const KeyframeId id = indexed.add_keyframe(std::move(view.observed), placed, {next - 1}, 0);
    for (std::size_t i = 0; i < view.points.size(); ++i) {
      Known& point = known[view.points[i]];
      const Sighting sighting{id, static_cast<std::int32_t>(i)};
      if (point.landmark.valid() && next - point.last_seen <= memory) {
        map.add_sighting(point.landmark, sighting);
      } else {
        point.landmark = map.add_landmark(placed * map[id].observed.points_in_camera[i], sighting);
      }
      point.last_seen = next;
    }
    return id;
  }
  KeyframeId add(const Rigid3& truth) { return add(truth, truth); }

  struct Known {
    LandmarkId landmark;
    std::int32_t last_seen = 0;
  };
  World world;
  int memory;
  std::vector<Known> known;
  IndexedMap indexed{Map(kRig, "ORB")};
  Map& map = indexed.edit();
};

inline double distance(const Rigid3& a, const Rigid3& b) {
  return (a.translation - b.translation).norm();
}

}  // namespace cairn::test
