// SPDX-License-Identifier: Apache-2.0
#include "cairn/slam/motion.h"

#include <Eigen/LU>
#include <cmath>

#include "cairn/geometry/camera_pose.h"
#include "cairn/geometry/pnp_ransac.h"
#include "cairn/matching/matching.h"

namespace cairn {
namespace {

constexpr double kDistanceFloor =
    10;  // bits, or units of byte descriptors: no match is told from a perfect one below it

struct Pairs {
  std::vector<Match> matches;
  std::vector<Eigen::Vector3d> points_in_reference;
  std::vector<Observation> seen_in_current;
};

Pairs pairs_of(const ReferencePoints& reference, const ObservedFrame& current,
               const std::vector<Match>& matches) {
  Pairs pairs;
  for (const Match& match : matches) {
    const Eigen::Vector3d& point = reference.points_in_camera[static_cast<std::size_t>(match.train)];
    if (!point.allFinite()) continue;
    pairs.matches.push_back(match);
    pairs.points_in_reference.push_back(point);
    pairs.seen_in_current.push_back(current.observations[static_cast<std::size_t>(match.query)]);
  }
  return pairs;
}

std::uint64_t seed_of(const SlamOptions& options, const ObservedFrame& reference,
                      const ObservedFrame& current) {
  const auto pair = static_cast<std::uint64_t>(reference.frame.value) << 32 |
                    static_cast<std::uint64_t>(current.frame.value);
  return options.seed * 0x9e3779b97f4a7c15ULL ^ pair;
}

}  // namespace

bool is_determined(const Matrix6d& covariance, double depth) {
  constexpr double kMaxRotationStd = 0.02;  // radians
  constexpr double kMaxShareOfDepth = 0.01;
  constexpr double kLeastMaxStd = 0.05;  // metres
  const double max_translation_std = std::fmax(kLeastMaxStd, kMaxShareOfDepth * depth);
  const Vector6d variances = covariance.diagonal();
  const bool rotation = variances.head<3>().maxCoeff() < kMaxRotationStd * kMaxRotationStd;
  const bool translation = variances.tail<3>().maxCoeff() < max_translation_std * max_translation_std;
  return rotation && translation && variances.minCoeff() > 0;
}

std::vector<Eigen::Vector3d> points_of(const Map& map, KeyframeId id) {
  const Keyframe& keyframe = map[id];
  const Rigid3 camera_from_world = keyframe.world_from_camera.inverse();
  std::vector<Eigen::Vector3d> points = keyframe.observed.points_in_camera;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const LandmarkId landmark = keyframe.landmarks[i];
    if (landmark.valid()) points[i] = camera_from_world * map[landmark].point_in_world;
  }
  return points;
}

Motion estimate_motion(const Rig& rig, const ReferencePoints& reference, const ObservedFrame& current,
                       const SlamOptions& options) {
  const auto all = match_mutual(current.features.descriptors, reference.observed.features.descriptors);
  const auto good = filter_by_distance(all, options.max_distance_factor, kDistanceFloor);
  const Pairs pairs = pairs_of(reference, current, good);
  Motion motion;
  motion.matches = static_cast<int>(pairs.points_in_reference.size());
  if (motion.matches < options.min_matches) return motion;
  RansacOptions ransac;
  ransac.seed = seed_of(options, reference.observed, current);
  const PnpResult rough = solve_pnp_ransac(rig, pairs.points_in_reference, pairs.seen_in_current, ransac);
  if (!rough.found()) return motion;
  const PoseEstimate refined =
      estimate_pose(rig, {pairs.points_in_reference, pairs.seen_in_current}, rough.camera_from_world);
  motion.inliers = static_cast<int>(refined.inliers.size());
  for (const std::int32_t i : refined.inliers)
    motion.pairs.push_back(pairs.matches[static_cast<std::size_t>(i)]);
  const bool enough =
      motion.inliers >= options.min_inliers && motion.inliers >= options.min_inlier_share * motion.matches;
  motion.found = refined.found() && enough && is_determined(refined.covariance, median_depth(current));
  constexpr int kFewestOfGuess = 8;
  motion.is_guess = !motion.found && refined.found() && motion.inliers >= kFewestOfGuess;
  motion.current_from_reference = refined.camera_from_world;
  if (motion.found) motion.information = refined.covariance.inverse();
  motion.norm = motion_norm(motion.current_from_reference);
  return motion;
}

const char* to_string(TrackingStatus status) {
  switch (status) {
    case TrackingStatus::implausible:
      return "too far";
    case TrackingStatus::tracked:
      return "too close";
    case TrackingStatus::keyframe:
      return "keyframe";
    case TrackingStatus::lost:
      break;
  }
  return "not matched";
}

TrackingStatus tracking_status(const Motion& motion, const SlamOptions& options, double steps) {
  if (!motion.found) return TrackingStatus::lost;
  if (motion.norm >= steps * options.max_motion) return TrackingStatus::implausible;
  if (motion.norm <= options.keyframe_threshold) return TrackingStatus::tracked;
  return TrackingStatus::keyframe;
}

bool is_plausible_loop(const Motion& motion, const SlamOptions& options) {
  return motion.found && motion.inliers >= options.loop_min_inliers &&
         motion.inliers >= options.loop_min_inlier_share * motion.matches &&
         motion.norm < options.max_loop_motion;
}

}  // namespace cairn
