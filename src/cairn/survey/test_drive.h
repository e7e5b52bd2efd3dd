// SPDX-License-Identifier: Apache-2.0
// What the tests of mapping share: a drive past points, without images.
#pragma once

#include <cstdint>
#include <vector>

#include "cairn/core/random.h"
#include "cairn/survey/landmarks.h"

namespace cairn::test {

inline constexpr Rig kDriveRig{700, 700, 620, 190, 0.54};

/// Points of one look have one descriptor.
struct DrivePoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  std::uint64_t look = 0;
};

inline void describe(std::uint64_t look, std::size_t row, Descriptors& descriptors) {
  Random bytes(77, look);
  for (std::size_t b = 0; b < descriptors.bytes(); ++b)
    descriptors.row(row)[b] = static_cast<std::uint8_t>(bytes.index(256));
}

/// Metre by metre along z on a slight bend.
inline WorldFromCamera drive_pose(int frame) {
  return WorldFromCamera(
      Rigid3{rotation_exp(frame * Eigen::Vector3d(0.001, 0.004, -0.002)), {0.03 * frame, 0, 1.0 * frame}});
}

/// Points 20 to 45 m before pose 0, each with a look of its own. The first fifteen frames see all of them.
inline std::vector<DrivePoint> points_ahead(std::size_t count, std::uint64_t seed = 1) {
  Random random(seed);
  std::vector<DrivePoint> points;
  for (std::size_t i = 0; i < count; ++i)
    points.push_back(
        {{random.uniform(-4, 4) + (i % 2 == 0 ? 1 : -1), random.uniform(-1, 1), random.uniform(20, 45)}, i});
  return points;
}

/// Frame number `frame` from `pose`: its feature i shows point i, wherever that is, with a disparity.
/// `noise_px` is the standard deviation of u, v and d; 0.5 is stated.
inline SurveyFrame see(const std::vector<DrivePoint>& points, int frame, const WorldFromCamera& pose,
                       double noise_px = 0) {
  constexpr double kPatch = 300;  // pixels * metres
  Random random(5, static_cast<std::uint64_t>(frame));
  SurveyFrame seen;
  seen.id = {frame};
  seen.given.world_from_camera = seen.world_from_camera = seen.odometry = pose;
  seen.camera_from_world = pose.inverse();
  seen.observed.frame = {frame};
  seen.observed.stamp_ns = 100'000'000LL * frame;
  seen.observed.features.descriptors = Descriptors(Norm::hamming, 32, points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d point = seen.camera_from_world * points[i].position;
    const Eigen::Vector3d noise(random.normal(), random.normal(), random.normal());
    const Eigen::Vector3d pixel = kDriveRig.project(point) + noise_px * noise;
    const Observation observation{pixel.x(), pixel.y(), pixel.z(), 0.5, 0.5};
    seen.observed.observations.push_back(observation);
    seen.observed.points_in_camera.push_back(point_in_camera(kDriveRig, observation));
    seen.observed.features.keypoints.push_back({static_cast<float>(pixel.x()), static_cast<float>(pixel.y()),
                                                static_cast<float>(kPatch / point.norm())});
    describe(points[i].look, i, seen.observed.features.descriptors);
  }
  seen.landmarks.resize(points.size());
  return seen;
}

/// Takes the disparity from a feature.
inline void forget_disparity(std::size_t feature, SurveyFrame& frame) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  frame.observed.observations[feature].d = kNaN;
  frame.observed.points_in_camera[feature].setConstant(kNaN);
}

/// The first frames of the drive.
inline FrameBuffer drive(const std::vector<DrivePoint>& points, int count, double noise_px = 0) {
  FrameBuffer frames;
  for (int i = 0; i < count; ++i) frames.push_back(see(points, i, drive_pose(i), noise_px));
  return frames;
}

/// `feature` in frames `first` to `last`.
inline std::vector<Sighting> sightings_of(std::int32_t feature, int first, int last) {
  std::vector<Sighting> sightings;
  for (int frame = first; frame <= last; ++frame) sightings.push_back({{frame}, feature});
  return sightings;
}

/// A track of that.
inline Track track_of(const FrameBuffer& frames, std::int32_t feature, int first, int last) {
  const SurveyFrame& newest = frames[KeyframeId{last}];
  return {sightings_of(feature, first, last),
          {{last}, feature},
          newest.odometry * newest.observed.points_in_camera[static_cast<std::size_t>(feature)]};
}

}  // namespace cairn::test
