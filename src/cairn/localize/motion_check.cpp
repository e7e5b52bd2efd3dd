// SPDX-License-Identifier: Apache-2.0
#include "cairn/localize/motion_check.h"

#include <numbers>

namespace cairn {

bool MotionCheck::fits(const StampedPose& now) const {
  if (!before_ || !last_) return true;
  constexpr double kSeconds = 1e-9, kRadians = std::numbers::pi / 180;
  const double first = kSeconds * static_cast<double>(last_->stamp_ns - before_->stamp_ns);
  const double second = kSeconds * static_cast<double>(now.stamp_ns - last_->stamp_ns);
  if (!(first > 0 && second > 0)) return true;
  const double ratio = second / first, freedom = 0.5 * second * (first + second);
  const Eigen::Vector3d &p0 = before_->world_from_camera.translation,
                        &p1 = last_->world_from_camera.translation, &p2 = now.world_from_camera.translation;
  const double away = (p2 - (p1 + ratio * (p1 - p0))).norm();
  const Rigid3 step0 = before_->world_from_camera.inverse() * last_->world_from_camera;
  const Rigid3 step1 = last_->world_from_camera.inverse() * now.world_from_camera;
  const double turned = (rotation_log(step1.rotation) - ratio * rotation_log(step0.rotation)).norm();
  return away <= options_.max_acceleration * freedom + options_.max_position &&
         turned <= options_.max_angular_acceleration * freedom + options_.max_angle_deg * kRadians;
}

void MotionCheck::check(std::int64_t stamp_ns, Localization& found) {
  if (!found.found()) return;
  const StampedPose now{stamp_ns, found.camera_from_world.inverse()};
  if (found.verdict == Verdict::good && !fits(now)) {
    found.verdict = Verdict::weak;
    found.weakness = Weakness::inconsistent_with_motion;
  }
  before_ = last_;
  last_ = now;
}

}  // namespace cairn
