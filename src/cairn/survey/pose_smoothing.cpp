// SPDX-License-Identifier: Apache-2.0
#include "cairn/survey/pose_smoothing.h"

#include <algorithm>

#include "cairn/geometry/camera_pose.h"

namespace cairn {
namespace {

constexpr double kTiny = 1e-18;  // radians, metres, squared: exact poses get all the weight

/// Says where motions lead from a frame in the middle.
struct Neighbour {
  KeyframeId id;
  Rigid3 neighbour_from_middle;
  double rotation_variance = 0, translation_variance = 0;  // of the motions up to there, per axis
};

KeyframeId shifted(KeyframeId id, int by) {
  return {id.value + by};
}

bool is_in(const FrameBuffer& frames, KeyframeId id) {
  return id >= frames.front().id && id <= frames.back().id;
}

/// Returns the frames after (direction 1) or before (-1) `middle`, the nearest first, as far as motions were
/// measured.
std::vector<Neighbour> follow_motions(const FrameBuffer& frames, KeyframeId middle, int direction,
                                      int reach) {
  std::vector<Neighbour> neighbours;
  Neighbour next{middle, {}};
  for (int k = 1; k <= reach; ++k) {
    next.id = shifted(middle, direction * k);
    if (!is_in(frames, next.id)) break;
    const auto& motion = frames[direction > 0 ? next.id : shifted(next.id, 1)].motion;
    if (!motion) break;
    const Rigid3 step = direction > 0 ? motion->previous_from_this.inverse() : motion->previous_from_this;
    next.neighbour_from_middle = step * next.neighbour_from_middle;
    next.rotation_variance += motion->rotation_variance;
    next.translation_variance += motion->translation_variance;
    neighbours.push_back(next);
  }
  return neighbours;
}

/// Computes the weights of the given poses of one side's neighbours, of variance `jitter` each, after motions
/// have carried them to the middle. Neighbours further away share the steps of the nearer: from the farthest
/// inwards, information J passes a step of variance v as J / (1 + J v), as in the filter of a random walk
/// (Kalman 1960).
std::vector<double> weights_of(const std::vector<Neighbour>& side, double jitter, double Neighbour::*way) {
  std::vector<double> weights(side.size(), 1 / jitter);
  double information = 0;
  for (std::size_t i = side.size(); i-- > 0;) {
    const double step = side[i].*way - (i > 0 ? side[i - 1].*way : 0.0);
    information += 1 / jitter;
    const double passed = 1 / (1 + information * step);
    for (std::size_t k = i; k < side.size(); ++k) weights[k] *= passed;
    information *= passed;
  }
  return weights;
}

struct Jitter {
  double rotation_variance = 0, translation_variance = 0;  // of one given pose, per axis
};

/// Measures by how much given motions scatter about the seen ones. What they differ by in the mean, step
/// after step, is a fault of the cameras' calibration, not jitter.
Jitter measure_jitter(const FrameBuffer& frames, KeyframeId id, int reach) {
  Vector6d sum = Vector6d::Zero(), squares = Vector6d::Zero();
  double rotation_noise = 0, translation_noise = 0;
  int count = 0;
  for (int k = -reach + 1; k <= reach; ++k) {
    const KeyframeId frame = shifted(id, k), before = shifted(frame, -1);
    if (!is_in(frames, frame) || !is_in(frames, before) || !frames[frame].motion) continue;
    const Rigid3 given =
        frames[before].given.world_from_camera.inverse() * frames[frame].given.world_from_camera;
    const Vector6d difference = left_perturbation(given, frames[frame].motion->previous_from_this);
    sum += difference;
    squares += difference.cwiseAbs2();
    rotation_noise += frames[frame].motion->rotation_variance;
    translation_noise += frames[frame].motion->translation_variance;
    ++count;
  }
  if (count == 0) return {};
  squares -=
      sum.cwiseAbs2() / count;  // the sum of steps has two poses' jitter only, which is next to nothing
  const auto variance = [&](double sum_of_squares, double noise) {
    return std::max(0.0, (sum_of_squares / 3 - noise) / (2.0 * count));
  };
  return {variance(squares.head<3>().sum(), rotation_noise),
          variance(squares.tail<3>().sum(), translation_noise)};
}

}  // namespace

std::optional<VisualMotion> measure_motion(const Rig& rig, const FrameBuffer& frames,
                                           std::span<const Track> tracks, const SurveyFrame& frame,
                                           std::span<const TrackMatch> matches) {
  constexpr std::size_t kMinInliers = 30;
  if (frames.empty()) return std::nullopt;
  std::vector<Eigen::Vector3d> points;
  std::vector<Observation> seen;
  for (const TrackMatch& match : matches) {
    points.push_back(tracks[static_cast<std::size_t>(match.track)].point_in_world);
    seen.push_back(frame.observed.observations[static_cast<std::size_t>(match.feature)]);
  }
  if (points.size() < kMinInliers) return std::nullopt;
  const PoseEstimate fit = estimate_pose(rig, {points, seen}, frame.odometry.inverse(),
                                         {.selection = PoseSelection::inliers_from_all});
  if (!fit.found() || fit.inliers.size() < std::max(kMinInliers, points.size() / 2)) return std::nullopt;
  const Matrix6d covariance = fit.variance_factor * fit.covariance;
  return VisualMotion{frames.back().odometry.inverse() * fit.camera_from_world.inverse(),
                      covariance.topLeftCorner<3, 3>().trace() / 3,
                      covariance.bottomRightCorner<3, 3>().trace() / 3};
}

WorldFromCamera smoothed_pose(const FrameBuffer& frames, KeyframeId id, int reach) {
  const WorldFromCamera& given = frames[id].given.world_from_camera;
  const Jitter jitter = measure_jitter(frames, id, reach);
  const double rotation_jitter = jitter.rotation_variance + kTiny,
               translation_jitter = jitter.translation_variance + kTiny;
  Eigen::Vector3d rotation = Eigen::Vector3d::Zero(), translation = Eigen::Vector3d::Zero();
  double rotation_weight = 1 / rotation_jitter, translation_weight = 1 / translation_jitter;
  for (const int direction : {1, -1}) {
    const auto side = follow_motions(frames, id, direction, reach);
    const auto by_rotation = weights_of(side, rotation_jitter, &Neighbour::rotation_variance),
               by_translation = weights_of(side, translation_jitter, &Neighbour::translation_variance);
    for (std::size_t i = 0; i < side.size(); ++i) {
      const Rigid3 carried = frames[side[i].id].given.world_from_camera * side[i].neighbour_from_middle;
      rotation += by_rotation[i] * rotation_log(given.rotation.conjugate() * carried.rotation);
      translation += by_translation[i] * (carried.translation - given.translation);
      rotation_weight += by_rotation[i], translation_weight += by_translation[i];
    }
  }
  WorldFromCamera smoothed = given;
  smoothed.rotation = (given.rotation * rotation_exp(rotation / rotation_weight)).normalized();
  smoothed.translation += translation / translation_weight;
  return smoothed;
}

std::vector<CameraFromWorld> cameras_around(const FrameBuffer& frames, KeyframeId middle, int reach) {
  std::vector<CameraFromWorld> cameras = frames.camera_poses();
  const Jitter jitter = measure_jitter(frames, middle, reach);
  const SurveyFrame& from = frames[middle];
  const int whole = static_cast<int>(frames.size());
  std::vector<Neighbour> neighbours = follow_motions(frames, middle, 1, whole);
  const auto before = follow_motions(frames, middle, -1, whole);
  neighbours.insert(neighbours.end(), before.begin(), before.end());
  for (const Neighbour& neighbour : neighbours) {
    const Rigid3 led = from.world_from_camera * neighbour.neighbour_from_middle.inverse();
    const Rigid3& given = frames[neighbour.id].given.world_from_camera;
    const double to_given_rotation =
        neighbour.rotation_variance / (neighbour.rotation_variance + jitter.rotation_variance + kTiny);
    const double to_given = neighbour.translation_variance /
                            (neighbour.translation_variance + jitter.translation_variance + kTiny);
    Rigid3 world_from_camera;
    world_from_camera.rotation = led.rotation.slerp(to_given_rotation, given.rotation);
    world_from_camera.translation = led.translation + to_given * (given.translation - led.translation);
    cameras[frames.position(neighbour.id)] = CameraFromWorld(world_from_camera.inverse());
  }
  return cameras;
}

}  // namespace cairn
