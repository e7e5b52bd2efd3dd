// SPDX-License-Identifier: Apache-2.0
#include "cairn/survey/pose_adjustment.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "cairn/core/median.h"
#include "cairn/geometry/camera_pose.h"
#include "cairn/optimize/bundle_adjustment.h"

namespace cairn {
namespace {

/// Sums what given and seen motions over `lag` frames differ by.
class MotionDifferences {
 public:
  MotionDifferences(const FrameBuffer& frames, KeyframeId first, KeyframeId last, int lag) : lag_(lag) {
    for (int k = first.value + lag; k <= last.value; ++k) add(frames, k);
  }

  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] Vector6d variances() const {
    return (squares_ - sum_.cwiseAbs2() / count_) / std::max(1, count_ - 1);
  }
  /// Returns the squared mean beyond what a mean of so many that scatter, and of no mean, has by chance.
  [[nodiscard]] Vector6d squared_mean() const {
    return ((sum_ / count_).cwiseAbs2() - 2 * variances() / count_).cwiseMax(0.0);
  }
  /// Returns the part of the variances that the noise of pixels explains.
  [[nodiscard]] Vector6d formal_variances() const { return formal_ / count_; }

 private:
  /// Adds the motion that ends at frame `k`, if the images show all of it.
  void add(const FrameBuffer& frames, int k) {
    Vector6d formal = Vector6d::Zero();
    for (int j = k - lag_ + 1; j <= k; ++j) {
      const auto& motion = frames[KeyframeId{j}].motion;
      if (!motion) return;
      formal.head<3>().array() += motion->rotation_variance;
      formal.tail<3>().array() += motion->translation_variance;
    }
    const SurveyFrame &before = frames[KeyframeId{k - lag_}], &frame = frames[KeyframeId{k}];
    const Rigid3 given = frame.given.world_from_camera.inverse() * before.given.world_from_camera,
                 seen = frame.odometry.inverse() * before.odometry;
    const Vector6d difference = left_perturbation(given, seen);
    sum_ += difference;
    squares_ += difference.cwiseAbs2();
    formal_ += formal;
    ++count_;
  }

  int lag_;
  Vector6d sum_ = Vector6d::Zero(), squares_ = Vector6d::Zero(), formal_ = Vector6d::Zero();
  int count_ = 0;
};

/// Collects cameras and tracks of a bundle.
class PoseBundle {
 public:
  PoseBundle(const Rig& rig, const FrameBuffer& frames, KeyframeId begin, KeyframeId first)
      : frames_(frames), begin_(begin) {
    problem_.rig = rig;
    for (KeyframeId id = begin; id <= frames.back().id; ++id.value) {
      problem_.camera_from_world.push_back(frames[id].camera_from_world);
      problem_.camera_fixed.push_back(id < first ? 1 : 0);
    }
  }

  void add_priors(KeyframeId first, const PoseNoise& noise) {
    const Vector6d least = least_variances();
    const Vector6d overconfidence = (noise.motion + least).cwiseQuotient(noise.formal + least);
    const Vector6d information = overconfidence.cwiseQuotient(noise.given + least);
    for (KeyframeId id = first; id <= frames_.back().id; ++id.value)
      problem_.priors.push_back(
          {camera_of(id), frames_[id].given.world_from_camera.inverse(), Matrix6d(information.asDiagonal())});
  }

  /// Adds what a track shows in the bundle's frames, if that says anything of their poses.
  void add(const Track& track) {
    const auto seen = std::find_if(track.observations.begin(), track.observations.end(),
                                   [&](const ObservationRef& other) { return other.keyframe >= begin_; });
    constexpr std::ptrdiff_t kFewest = 3;  // two agree by chance
    if (track.observations.end() - seen < kFewest) return;
    const auto point = static_cast<std::int32_t>(problem_.points_in_world.size());
    const SurveyFrame& measured = frames_[track.measured.keyframe];
    const auto feature = static_cast<std::size_t>(track.measured.feature);
    problem_.points_in_world.push_back(measured.world_from_camera *
                                       measured.observed.points_in_camera[feature]);
    for (auto it = seen; it != track.observations.end(); ++it)
      problem_.observations.push_back({camera_of(it->keyframe), point, observation_of(frames_, *it)});
  }

  [[nodiscard]] BundleProblem& problem() { return problem_; }
  [[nodiscard]] std::int32_t camera_of(KeyframeId id) const { return id.value - begin_.value; }

 private:
  const FrameBuffer& frames_;
  KeyframeId begin_;
  BundleProblem problem_;
};

/// Returns the length of a move over the standard deviation in its direction; NaN if none is stated.
double in_sigmas(const Eigen::Vector3d& move, const Eigen::Matrix3d& covariance) {
  const double squared = move.squaredNorm();
  if (covariance.isZero(0)) return std::numeric_limits<double>::quiet_NaN();
  if (squared == 0) return 0;
  const double variance = move.dot(covariance * move) / squared;
  return variance > 0 ? std::sqrt(squared / variance) : std::numeric_limits<double>::infinity();
}

/// Adjusts, leaves out what does not fit, and adjusts again.
void adjust_twice(BundleProblem& problem, const Executor& executor) {
  const BundleReport report = adjust_bundle(problem, {}, executor);
  std::size_t next = 0;
  std::erase_if(problem.observations, [&](const BundleObservation&) { return report.inlier[next++] == 0; });
  (void)adjust_bundle(problem, {}, executor);
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

namespace {

/// Returns the mean of the variances that the given poses of frames `first` to `last` state; zero for what
/// they do not state.
Vector6d stated_variances(const FrameBuffer& frames, KeyframeId first, KeyframeId last) {
  Vector6d sum = Vector6d::Zero();
  for (KeyframeId id = first; id <= last; ++id.value)
    sum += stated_covariance(frames[id].given).diagonal().cwiseMax(0.0);
  return sum / (last.value - first.value + 1);
}

/// Returns the variances of given poses with which the adjusted ones follow an error that wanders, of
/// variance `wander`, as slowly as they may: zero where none does. Poses of variance g, with motions that
/// drift by q a frame, draw by k = sqrt(q / g) a frame (a Kalman filter's gain). If all the drift is of the
/// images, that leaves an error of variance q / (2 k); if these show a motion that is wrong in each frame, by
/// a variance `steady`, one of steady / k^2; neither may be more than `wander`. Tracks tie a frame to many
/// before it, about four times as strongly as the motion between neighbours does, so that the gain is four
/// times what it would be. All `frames` together weigh at least as one pose. A centre that is drawn along one
/// axis moves along others and turns the camera, so that the largest gain of the centre holds for all axes.
Vector6d variances_of_wander(const Vector6d& wander, const Vector6d& steady, int frames,
                             const Vector6d& motion) {
  constexpr double kTied = 4;
  Vector6d gain = Vector6d::Zero();
  for (Eigen::Index i = 0; i < 6; ++i)
    if (wander[i] > 0)
      gain[i] = std::max({kTied * motion[i] / wander[i], 2 * kTied * std::sqrt(steady[i] / wander[i]),
                          std::sqrt(motion[i] / (frames * wander[i]))});
  gain = gain.cwiseMax(gain.tail<3>().maxCoeff());
  return (wander.array() > 0 && gain.array() > 0).select(motion.cwiseQuotient(gain.cwiseAbs2()), 0);
}

}  // namespace

PoseNoise measure_noise(const FrameBuffer& frames, KeyframeId first, KeyframeId last) {
  constexpr int kLag = 8;                // frames: what drifts has come further than jitter
  constexpr double kLeastJitter = 0.25;  // share of what neighbours differ by, as all are estimates
  const MotionDifferences near(frames, first, last, 1), far(frames, first, last, kLag);
  PoseNoise noise;
  if (near.count() < 2) return noise;
  noise.formal = noise.motion = near.formal_variances();
  if (far.count() > 1) {
    // Jitter alone scatters by this, since only each eighth of the motions over eight frames is new; half of
    // it, because to take drift for jitter does more harm.
    const double scatter = 1 + 0.5 * std::sqrt(2.0 * kLag / far.count());
    const Vector6d drift = (far.variances() - scatter * near.variances()) / (kLag - 1);
    noise.motion = noise.formal.cwiseMax(drift.cwiseMin((1 - kLeastJitter) * near.variances()));
  }
  const Vector6d jitter = (near.variances() - noise.formal) / 2;
  noise.given = ((near.variances() - noise.motion) / 2).cwiseMax(kLeastJitter * jitter).cwiseMax(0.0);
  const Vector6d wander = (stated_variances(frames, first, last) - noise.given).cwiseMax(0.0);
  const int count = last.value - first.value + 1;
  noise.given = noise.given.cwiseMax(variances_of_wander(wander, near.squared_mean(), count, noise.motion));
  return noise;
}

MoveInSigmas move_in_sigmas(const GivenPose& given, const WorldFromCamera& adjusted) {
  const PoseUncertainty& stated = given.uncertainty.value();
  const Rigid3& before = given.world_from_camera;
  return {in_sigmas(adjusted.translation - before.translation, stated.position),
          in_sigmas(rotation_log(adjusted.rotation * before.rotation.conjugate()), stated.rotation)};
}

MovesInSigmas summarise_moves(std::span<const MoveInSigmas> moves) {
  MovesInSigmas result;
  result.frames = static_cast<std::int64_t>(moves.size());
  if (moves.empty()) return result;
  for (double MoveInSigmas::*part : {&MoveInSigmas::position, &MoveInSigmas::rotation}) {
    std::vector<double> sizes;
    for (const MoveInSigmas& move : moves)
      if (!std::isnan(move.*part)) sizes.push_back(move.*part);
    if (sizes.empty()) {
      result.largest.*part = result.median.*part = std::numeric_limits<double>::quiet_NaN();
      continue;
    }
    result.largest.*part = *std::max_element(sizes.begin(), sizes.end());
    result.median.*part = median(std::move(sizes));
  }
  return result;
}

void adjust_poses(const Rig& rig, std::span<const Track* const> tracks, KeyframeId first, int reach,
                  const Executor& executor, FrameBuffer& frames) {
  const KeyframeId begin{std::max(frames.front().id.value, first.value - reach)};
  PoseBundle bundle(rig, frames, begin, first);
  bundle.add_priors(first, measure_noise(frames, begin, frames.back().id));
  for (const Track* track : tracks) bundle.add(*track);
  BundleProblem& problem = bundle.problem();
  if (problem.observations.empty()) return;
  adjust_twice(problem, executor);
  for (KeyframeId id = first; id <= frames.back().id; ++id.value) {
    SurveyFrame& frame = frames[id];
    const Rigid3& adjusted = problem.camera_from_world[static_cast<std::size_t>(bundle.camera_of(id))];
    frame.world_from_camera = WorldFromCamera(adjusted.inverse());
    frame.camera_from_world = frame.world_from_camera.inverse();  // the bits that a checkpoint gives back
  }
}

}  // namespace cairn
