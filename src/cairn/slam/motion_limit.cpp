// SPDX-License-Identifier: Apache-2.0
#include "cairn/slam/motion_limit.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace cairn {

double steps_between(std::int64_t from_ns, std::int64_t to_ns, const SlamOptions& options) {
  if (!(options.frame_period_s > 0)) return 1;
  const double seconds = 1e-9 * std::abs(static_cast<double>(to_ns) - static_cast<double>(from_ns));
  return std::max(1.0, seconds / options.frame_period_s);
}

bool is_plausible_motion(const Rigid3& motion, std::int64_t from_ns, std::int64_t to_ns,
                         const SlamOptions& options) {
  return motion_norm(motion) < options.max_motion * steps_between(from_ns, to_ns, options);
}

void KnownPoses::remember(const Map& map, KeyframeId reference, const Rigid3& reference_from_frame,
                          std::int64_t stamp_ns) {
  const std::int32_t component = map.component_of(reference);
  std::erase_if(poses_, [&](const Known& known) { return map.component_of(known.reference) == component; });
  poses_.push_back({reference, reference_from_frame, stamp_ns});
}

bool KnownPoses::allow(const Map& map, KeyframeId reference, const Rigid3& world_from_camera,
                       std::int64_t stamp_ns, const SlamOptions& options) const {
  const std::int32_t component = map.component_of(reference);
  const auto known = std::find_if(poses_.rbegin(), poses_.rend(), [&](const Known& one) {
    return map.component_of(one.reference) == component;
  });
  if (known == poses_.rend()) return true;
  const Rigid3 world_from_known = map.world_from_camera(known->reference) * known->reference_from_frame;
  return is_plausible_motion(world_from_known.inverse() * world_from_camera, known->stamp_ns, stamp_ns,
                             options);
}

bool can_be_joined(const Map& map, std::int32_t component_a, std::int32_t component_b, const Rigid3& a_from_b,
                   const SlamOptions& options) {
  struct PoseInA {
    std::int64_t stamp_ns;
    Rigid3 a_from_camera;
  };
  std::optional<PoseInA> last_in_a, last_in_b;
  for (const KeyframeId id : map.keyframe_ids()) {
    const std::int32_t component = map.component_of(id);
    const ObservedFrame& observed = map[id].observed;
    if ((component != component_a && component != component_b) || !observed.frame.valid())
      continue;  // or of an earlier recording
    const Rigid3 pose = map.world_from_camera(id);
    const PoseInA here{observed.stamp_ns, component == component_a ? pose : a_from_b * pose};
    const auto& before = component == component_a ? last_in_b : last_in_a;
    if (before && !is_plausible_motion(before->a_from_camera.inverse() * here.a_from_camera, before->stamp_ns,
                                       here.stamp_ns, options))
      return false;
    (component == component_a ? last_in_a : last_in_b) = here;
  }
  return true;
}

}  // namespace cairn
