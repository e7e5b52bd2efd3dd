// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cairn/map/map.h"
#include "cairn/matching/matching.h"
#include "cairn/slam/options.h"

namespace cairn {

/// Holds the motion between two frames as estimated from their features.
struct Motion {
  bool found = false;     ///< false: too few matches or inliers, or a pose that they do not determine
  bool is_guess = false;  ///< not found, but so many agree that the motion is worth a search around it
  Rigid3 current_from_reference;
  Matrix6d information = Matrix6d::Zero();  ///< of the left perturbation (rotation, translation)
  int matches = 0;
  int inliers = 0;
  double norm = 0;           ///< motion_norm: rad + m
  std::vector<Match> pairs;  ///< inliers; query: feature of `current`, train: feature of `reference`
};

/// Holds what a motion is measured against: a frame, and a point for each of its features, NaN if unknown.
struct ReferencePoints {
  const ObservedFrame& observed;
  std::span<const Eigen::Vector3d> points_in_camera;
};

/// Returns the points of a keyframe's features in its camera frame: those of their landmarks, else those of
/// their depths; NaN without either.
[[nodiscard]] std::vector<Eigen::Vector3d> points_of(const Map& map, KeyframeId keyframe);

/// Estimates the motion from points of `reference` and observations of `current`: matches descriptors, solves
/// P3P in RANSAC and refines on all inliers. Deterministic, given the seed and the two frames.
[[nodiscard]] Motion estimate_motion(const Rig& rig, const ReferencePoints& reference,
                                     const ObservedFrame& current, const SlamOptions& options);

/// Tells whether a pose with this covariance is determined: to 0.02 rad, and to 5 cm or a hundredth of
/// `depth`, a typical depth of what determines it, metres. It is not if all inliers are on a line or far
/// away.
[[nodiscard]] bool is_determined(const Matrix6d& covariance, double depth);

/// Says what became of a frame.
enum class TrackingStatus {
  lost,         ///< no pose found
  implausible,  ///< a motion of max_motion or more: probably wrong, and refused
  tracked,      ///< tracked; no keyframe is due
  keyframe,     ///< tracked, and a keyframe is due or made
};

/// Returns "not matched", "too far", "too close" or "keyframe", in the order of TrackingStatus.
[[nodiscard]] const char* to_string(TrackingStatus status);

/// Returns the status of a motion between frames `steps` frame periods apart (see steps_between), by
/// motion.norm.
[[nodiscard]] TrackingStatus tracking_status(const Motion& motion, const SlamOptions& options,
                                             double steps = 1);
/// Returns whether a motion between frames that need not be neighbours may be believed, as for a loop or a
/// frame after tracking was lost: it reaches loop_min_inliers and loop_min_inlier_share, and is below
/// max_loop_motion.
[[nodiscard]] bool is_plausible_loop(const Motion& motion, const SlamOptions& options);

}  // namespace cairn
