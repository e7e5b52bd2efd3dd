// SPDX-License-Identifier: Apache-2.0
#include "cairn/testing/survey/point_drive.h"

#include <limits>

#include "cairn/core/random.h"
#include "cairn/testing/features/random_descriptor.h"
#include "cairn/testing/geometry/random_points.h"

namespace cairn::testkit {

std::vector<DrivePoint> roadside_points(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<DrivePoint> points;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d side(i % 2 == 0 ? 1 : -1, 0, 0);
    points.push_back({point_in_box(random, {-4, -1, 20}, {4, 1, 45}) + side, i});
  }
  return points;
}

SurveyFrame see(const std::vector<DrivePoint>& points, int frame, const WorldFromCamera& pose,
                double noise_px) {
  constexpr double kPatch = 300, kSigma = 0.5;  // pixels * metres, pixels
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
    const Observation observation =
        observe(random, kDriveRig.project(point), {kSigma, kSigma, noise_px / kSigma});
    seen.observed.observations.push_back(observation);
    seen.observed.points_in_camera.push_back(point_in_camera(kDriveRig, observation));
    seen.observed.features.keypoints.push_back({static_cast<float>(observation.u),
                                                static_cast<float>(observation.v),
                                                static_cast<float>(kPatch / point.norm())});
    put_look(kDriveLooks, points[i].look, i, seen.observed.features.descriptors);
  }
  seen.landmarks.resize(points.size());
  return seen;
}

void forget_disparity(std::size_t feature, SurveyFrame& frame) {
  forget_disparity(frame.observed.observations[feature]);
  frame.observed.points_in_camera[feature].setConstant(std::numeric_limits<double>::quiet_NaN());
}

FrameBuffer drive(const std::vector<DrivePoint>& points, int count, double noise_px) {
  FrameBuffer frames;
  for (int i = 0; i < count; ++i) frames.push_back(see(points, i, on_bend(i), noise_px));
  return frames;
}

std::vector<ObservationRef> observations_of(std::int32_t feature, int first, int last) {
  std::vector<ObservationRef> observations;
  for (int frame = first; frame <= last; ++frame) observations.push_back({{frame}, feature});
  return observations;
}

Track track_of(const FrameBuffer& frames, std::int32_t feature, int first, int last) {
  const SurveyFrame& newest = frames[KeyframeId{last}];
  return {observations_of(feature, first, last),
          {{last}, feature},
          newest.odometry * newest.observed.points_in_camera[static_cast<std::size_t>(feature)]};
}

}  // namespace cairn::testkit
