// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cairn/map/map.h"
#include "cairn/matching/matching.h"
#include "cairn/slam/options.h"

namespace cairn {

/// The motion between two frames, as far as their features tell.
struct Motion {
  bool found = false;  ///< false: too few matches or inliers, or a pose that they do not determine
  Rigid3 current_from_reference;
  Matrix6d information = Matrix6d::Zero();  ///< of the left perturbation (rotation, translation)
  int matches = 0;
  int inliers = 0;
  double norm = 0;           ///< motion_norm: rad + m
  std::vector<Match> pairs;  ///< the inliers: query is the feature of `current`, train that of `reference`
};

/// What a motion is measured against: a frame, and a point for each of its features, NaN where none is known.
struct ReferencePoints {
  const ObservedFrame& observed;
  std::span<const Eigen::Vector3d> points_in_camera;
};

/// The points of a keyframe's features: those of its landmarks; without one, what its depth says.
[[nodiscard]] std::vector<Eigen::Vector3d> points_of(const Map& map, KeyframeId keyframe);

/// Matches descriptors, solves P3P in RANSAC and refines on all inliers: points of `reference`, observations
/// of `current`. Deterministic from (seed, the two frames).
[[nodiscard]] Motion estimate_motion(const Rig& rig, const ReferencePoints& reference,
                                     const ObservedFrame& current, const SlamOptions& options);

/// Says what became of a frame.
enum class TrackingStatus {
  lost,         ///< no motion found
  implausible,  ///< a motion of max_motion or more: probably wrong, and refused
  tracked,      ///< and not worth a keyframe
  keyframe,     ///< tracked, and a keyframe
};

[[nodiscard]] const char* to_string(TrackingStatus status);

/// Returns the status of a motion between frames `steps` frame periods apart (see steps_between), by
/// motion.norm.
[[nodiscard]] TrackingStatus tracking_status(const Motion& motion, const SlamOptions& options,
                                             double steps = 1);
/// Tells whether a motion may be believed between frames that need not be neighbours, as those of a loop or a
/// frame after being lost: loop_min_inliers and loop_min_inlier_share are reached, and the motion is below
/// max_loop_motion.
[[nodiscard]] bool is_plausible_loop(const Motion& motion, const SlamOptions& options);

}  // namespace cairn
