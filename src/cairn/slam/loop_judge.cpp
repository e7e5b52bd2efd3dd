// SPDX-License-Identifier: Apache-2.0
#include "cairn/slam/loop_judge.h"

#include <cmath>

namespace cairn {
namespace {

// Largest error of odometry as a share of the path, with a good margin: a few percent are usual.
constexpr double kDriftShare = 0.1;
constexpr double kDriftMetres = 0.5;
constexpr double kDriftRadians = 0.3;
constexpr double kDriftRadiansPerMetre = 0.01;

constexpr int kConfirmWithin = 10;  // keyframes
// Largest difference of two corrections that are taken as equal: the noise of two measurements of one place,
// and the drift of odometry between them.
constexpr double kSameShare = 0.2;
constexpr double kSameMetres = 0.1;
constexpr double kSameRadians = 0.05;

bool is_plausible(const Map& map, const LoopHypothesis& loop, const Rigid3& correction_at_current) {
  const double length = path_length(map, loop.candidate, loop.current);
  return correction_at_current.translation.norm() < kDriftMetres + kDriftShare * length &&
         rotation_angle(correction_at_current.rotation) < kDriftRadians + kDriftRadiansPerMetre * length;
}

}  // namespace

double path_length(const Map& map, KeyframeId from, KeyframeId to) {
  double length = 0;
  for (std::int32_t k = from.value; k < to.value; ++k) {
    const Rigid3 step = map.world_from_camera({k}).inverse() * map.world_from_camera({k + 1});
    if (map.component_of({k}) == map.component_of({k + 1})) length += step.translation.norm();
  }
  return length;
}

LoopVerdict LoopJudge::judge(const Map& map, const LoopHypothesis& loop) {
  if (loop.agrees) return LoopVerdict::agrees;
  const Rigid3 world_from_current = map.world_from_camera(loop.current);
  const Rigid3 corrected_from_current = map.world_from_camera(loop.candidate) * loop.candidate_from_current;
  const Rigid3 correction = world_from_current.inverse() * corrected_from_current;  // in the camera
  const std::int32_t component = map.component_of(loop.current), into = map.component_of(loop.candidate);
  const bool same_component = component == into;
  if (same_component && !is_plausible(map, loop, correction)) return LoopVerdict::implausible;

  const std::optional<Pending> before = pending_;
  pending_ = {loop.current, corrected_from_current * world_from_current.inverse(), component, into};
  if (!before || before->component != component || before->into != into ||
      loop.current.value - before->current.value > kConfirmWithin)
    return LoopVerdict::unconfirmed;
  const Rigid3 expected = before->corrected_from_world * world_from_current;
  const Rigid3 difference = expected.inverse() * corrected_from_current;
  const double size = same_component ? correction.translation.norm() : 0.0;
  const bool same = difference.translation.norm() < kSameMetres + kSameShare * size &&
                    rotation_angle(difference.rotation) < kSameRadians;
  if (!same) return LoopVerdict::unconfirmed;
  pending_.reset();
  return LoopVerdict::believed;
}

}  // namespace cairn
