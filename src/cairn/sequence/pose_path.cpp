// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/pose_path.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace cairn {
namespace {

double seconds_between(std::int64_t from_ns, std::int64_t to_ns) {
  return 1e-9 * (static_cast<double>(to_ns) - static_cast<double>(from_ns));
}

/// Returns Lagrange's weights at `t` of values at the times `knots`.
template <std::size_t N>
std::array<double, N> lagrange_weights(const std::array<double, N>& knots, double t) {
  std::array<double, N> weights{};
  for (std::size_t i = 0; i < N; ++i) {
    weights[i] = 1;
    for (std::size_t j = 0; j < N; ++j)
      if (j != i) weights[i] *= (t - knots[j]) / (knots[i] - knots[j]);
  }
  return weights;
}

/// Interpolates N poses from `first` on, `t` seconds after the pose `origin`, which is one of them.
template <std::size_t N>
Rigid3 interpolate(const SubjectPose* first, const SubjectPose& origin, double t) {
  std::array<double, N> knots{};
  for (std::size_t i = 0; i < N; ++i) knots[i] = seconds_between(origin.stamp_ns, first[i].stamp_ns);
  const std::array<double, N> weights = lagrange_weights(knots, t);
  const Rigid3& base = origin.world_from_subject;
  Eigen::Vector3d translation = Eigen::Vector3d::Zero(), turn = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < N; ++i) {
    const Rigid3& pose = first[i].world_from_subject;
    translation += weights[i] * (pose.translation - base.translation);
    turn += weights[i] * rotation_log(base.rotation.conjugate() * pose.rotation);
  }
  return {(base.rotation * rotation_exp(turn)).normalized(), base.translation + translation};
}

}  // namespace

PosePath::PosePath(std::vector<SubjectPose> poses, double max_gap_s)
    : poses_(std::move(poses)), max_gap_s_(max_gap_s) {}

/// Returns whether there is a pose after `before`, near enough.
bool PosePath::is_near(std::size_t before) const {
  return before + 1 < poses_.size() &&
         seconds_between(poses_[before].stamp_ns, poses_[before + 1].stamp_ns) <= max_gap_s_;
}

Rigid3 PosePath::between(std::size_t before, double seconds) const {
  const SubjectPose& origin = poses_[before];
  if (before > 0 && is_near(before - 1) && is_near(before + 1))
    return interpolate<4>(&poses_[before - 1], origin, seconds);
  return interpolate<2>(&origin, origin, seconds);
}

std::optional<Rigid3> PosePath::at(std::int64_t stamp_ns, double offset_s) const {
  constexpr double kRounded = 1e-3;  // seconds: stamps are often rounded
  if (poses_.empty()) return std::nullopt;
  const std::int64_t wanted = stamp_ns - std::llround(1e9 * offset_s);
  const auto after =
      std::upper_bound(poses_.begin(), poses_.end(), wanted,
                       [](std::int64_t t, const SubjectPose& pose) { return t < pose.stamp_ns; });
  const auto next = static_cast<std::size_t>(after - poses_.begin());
  if (next > 0 && is_near(next - 1))
    return between(next - 1, seconds_between(poses_[next - 1].stamp_ns, wanted));
  for (const std::size_t near : {next - 1, next})  // next - 1 wraps around to no index at the start
    if (near < poses_.size() && std::abs(seconds_between(poses_[near].stamp_ns, wanted)) <= kRounded)
      return poses_[near].world_from_subject;
  return std::nullopt;
}

}  // namespace cairn
