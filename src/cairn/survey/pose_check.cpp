// SPDX-License-Identifier: Apache-2.0
#include "cairn/survey/pose_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "cairn/core/error.h"
#include "cairn/core/median.h"
#include "cairn/geometry/pnp_ransac.h"
#include "cairn/matching/matching.h"
#include "cairn/observe/frame_observer.h"
#include "cairn/survey/pose_readings.h"

namespace cairn {
namespace {

constexpr std::size_t kMostPairs = 12;
constexpr int kFewestPairs = 3;
constexpr double kFewestPx = 3;   // of motion in the image: less does not tell readings apart
constexpr double kEnoughPx = 10;  // else a frame further on is taken

/// Holds two frames and the motion between them as measured in their images.
struct SeenMotion {
  std::size_t first = 0, second = 0;  // in the sequence
  Rigid3 second_from_first;
  std::vector<Eigen::Vector3d> points_in_first;
  std::vector<Eigen::Vector2d> pixels_in_second;
  double flow_px = 0;
};

/// Computes the median distance of the points in the second image from where a motion puts them, pixels;
/// infinite behind the camera.
double error_of(const Rig& rig, const SeenMotion& motion, const Rigid3& second_from_first) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < motion.points_in_first.size(); ++i) {
    const Eigen::Vector3d point = second_from_first * motion.points_in_first[i];
    errors.push_back(point.z() > 0 ? (rig.project(point).head<2>() - motion.pixels_in_second[i]).norm()
                                   : std::numeric_limits<double>::infinity());
  }
  return median(std::move(errors));
}

std::optional<SeenMotion> motion_between(const Rig& rig, const ObservedFrame& first,
                                         const ObservedFrame& second) {
  constexpr double kRatio = 0.8;
  std::vector<Eigen::Vector3d> points;
  std::vector<Observation> seen;
  const Descriptors& looks = first.features.descriptors;
  for (const Match& match :
       match_descriptors(looks, second.features.descriptors, {descriptor_limit(looks), kRatio, true})) {
    const Eigen::Vector3d& point = first.points_in_camera[static_cast<std::size_t>(match.query)];
    if (!point.allFinite()) continue;
    points.push_back(point);
    seen.push_back(second.observations[static_cast<std::size_t>(match.train)]);
  }
  const PnpResult found = solve_pnp_ransac(rig, points, seen, {});
  if (!found.found()) return std::nullopt;
  SeenMotion motion;
  motion.second_from_first = found.camera_from_world;
  for (const std::int32_t i : found.inliers) {
    motion.points_in_first.push_back(points[static_cast<std::size_t>(i)]);
    motion.pixels_in_second.emplace_back(seen[static_cast<std::size_t>(i)].u,
                                         seen[static_cast<std::size_t>(i)].v);
  }
  motion.flow_px = error_of(rig, motion, {});
  return motion;
}

/// Measures motions that begin at some frames of the sequence.
class MotionProbe {
 public:
  MotionProbe(const Sequence& sequence, const GivenPoses& poses, const ObserverOptions& options)
      : rig_(rig_of(sequence.calibration, options.depth_noise)), observer_(sequence, options) {
    for (std::size_t i = 0; i < poses.frames.size(); ++i)
      if (poses.frames[i]) posed_.push_back(i);
  }

  /// Measures the motion from the frame at `position` of those with a pose. Returns nullopt if the images
  /// show no useful motion.
  [[nodiscard]] std::optional<SeenMotion> from(std::size_t position) const {
    const LoadedFrame first = observer_.load(posed_[position]);
    if (first.failure) return std::nullopt;
    std::optional<SeenMotion> best;
    for (const std::size_t step : {1U, 3U, 9U}) {
      if (position + step >= posed_.size()) break;
      const LoadedFrame second = observer_.load(posed_[position + step]);
      auto motion = second.failure ? std::nullopt : motion_between(rig_, first.observed, second.observed);
      if (!motion) break;
      motion->first = posed_[position];
      motion->second = posed_[position + step];
      best = std::move(motion);
      if (best->flow_px >= kEnoughPx) break;
    }
    return best && best->flow_px >= kFewestPx ? best : std::nullopt;
  }

  [[nodiscard]] std::vector<SeenMotion> spread(const Executor& executor) const {
    const std::size_t places = posed_.empty() ? 0 : posed_.size() - 1;
    const std::size_t count = std::min(places, kMostPairs);
    auto found = executor.map<std::optional<SeenMotion>>(
        count, [&](std::size_t i) { return from((2 * i + 1) * places / (2 * count)); });
    std::vector<SeenMotion> motions;
    for (auto& motion : found)
      if (motion) motions.push_back(std::move(*motion));
    return motions;
  }

  [[nodiscard]] const Rig& rig() const { return rig_; }

 private:
  Rig rig_;
  FrameObserver observer_;
  std::vector<std::size_t> posed_;
};

/// Holds how far poses and images differ, as medians over the motions.
struct Disagreement {
  double error_px = 0;
  double share = 0;  // of the motion in the image
};

Disagreement disagreement(const Rig& rig, const std::vector<SeenMotion>& motions, const CameraPoses& poses) {
  std::vector<double> errors, shares;
  for (const SeenMotion& motion : motions) {
    const auto &first = poses[motion.first], &second = poses[motion.second];
    const double error = first && second ? error_of(rig, motion, Rigid3(second->inverse() * *first))
                                         : std::numeric_limits<double>::infinity();
    errors.push_back(error);
    shares.push_back(error / motion.flow_px);
  }
  return {median(std::move(errors)), median(std::move(shares))};
}

void fill_figures(const std::vector<SeenMotion>& motions, const CameraPoses& poses, PoseCheck& check) {
  std::vector<double> flows, image_turns, pose_turns, image_ways, pose_ways;
  constexpr double kDegrees = 180 / std::numbers::pi;
  for (const SeenMotion& motion : motions) {
    const Rigid3 by_poses = poses[motion.second]->inverse() * *poses[motion.first];
    flows.push_back(motion.flow_px);
    image_turns.push_back(kDegrees * rotation_angle(motion.second_from_first.rotation));
    pose_turns.push_back(kDegrees * rotation_angle(by_poses.rotation));
    image_ways.push_back(motion.second_from_first.translation.norm());
    pose_ways.push_back(by_poses.translation.norm());
  }
  check.flow_px = median(std::move(flows));
  check.image_rotation_deg = median(std::move(image_turns));
  check.pose_rotation_deg = median(std::move(pose_turns));
  check.image_motion_m = median(std::move(image_ways));
  check.pose_motion_m = median(std::move(pose_ways));
}

/// Looks for the best reading that agrees with the images; two misreadings at once are tried only if no
/// single one does.
void look_for_reading(const Rig& rig, const std::vector<SeenMotion>& motions, double given_share,
                      const std::vector<PoseReading>& readings, PoseCheck& check) {
  constexpr double kAgrees = 0.25, kBetter = 4;
  for (const bool combined : {false, true}) {
    double best = std::min(kAgrees, given_share / kBetter);
    for (const PoseReading& reading : readings) {
      if (reading.is_combined != combined) continue;
      const Disagreement found = disagreement(rig, motions, reading.poses);
      if (!(found.share < best)) continue;
      best = found.share;
      check.verdict = PoseVerdict::misread;
      check.reading = reading.name;
      check.remedy = reading.remedy;
      check.reading_error_px = found.error_px;
    }
    if (check.verdict == PoseVerdict::misread) return;
  }
}

std::string pixels(double error_px) {
  return std::isfinite(error_px) ? fmt::format("{:.1f} px", error_px) : "behind the camera, not where";
}

}  // namespace

PoseCheck check_poses(const Sequence& sequence, const GivenPoses& poses, const ObserverOptions& options,
                      const Executor& executor) {
  PoseCheck check;
  if (!sequence.calibration.depth && !sequence.calibration.baseline) return check;
  ObserverOptions quick = options;
  quick.features = {};
  const MotionProbe probe(sequence, poses, quick);
  const std::vector<SeenMotion> motions = probe.spread(executor);
  check.pairs = static_cast<int>(motions.size());
  if (check.pairs < kFewestPairs) return check;
  const CameraPoses given = camera_poses(poses);
  fill_figures(motions, given, check);
  const Disagreement as_given = disagreement(probe.rig(), motions, given);
  check.error_px = as_given.error_px;
  constexpr double kSuspicious = 0.1, kSuspiciousPx = 4, kContradicts = 0.5;
  check.verdict = as_given.share < kContradicts ? PoseVerdict::agreement : PoseVerdict::contradiction;
  if (as_given.share >= kSuspicious && as_given.error_px >= kSuspiciousPx)
    look_for_reading(probe.rig(), motions, as_given.share, other_readings(sequence, poses), check);
  return check;
}

std::string describe(const PoseCheck& check) {
  return fmt::format(
      "in {} pairs of frames the images show a motion of {:.2f} degrees and {:.2f} m (median), the poses "
      "{:.2f} "
      "degrees and {:.2f} m; a point that moves by {:.1f} px in the image lies {} from where the poses put "
      "it",
      check.pairs, check.image_rotation_deg, check.image_motion_m, check.pose_rotation_deg,
      check.pose_motion_m, check.flow_px, pixels(check.error_px));
}

void refuse_misread(const PoseCheck& check, const Sequence& sequence, const GivenPoses& poses) {
  if (check.verdict != PoseVerdict::misread) return;
  const std::string source = poses.source.empty() ? sequence.folder.string() : poses.source.string();
  throw InputError({source, 0, "poses that move the camera as the images do",
                    fmt::format("a contradiction: {}. Read as {}, the poses agree with the images ({})",
                                describe(check), check.reading, pixels(check.reading_error_px)),
                    check.remedy});
}

std::string_view to_string(PoseVerdict verdict) {
  switch (verdict) {
    case PoseVerdict::agreement:
      return "agreement";
    case PoseVerdict::contradiction:
      return "contradiction";
    case PoseVerdict::misread:
      return "misread";
    case PoseVerdict::undecided:
      break;
  }
  return "undecided";
}

}  // namespace cairn
