// SPDX-License-Identifier: Apache-2.0
// What a user of the library writes. Compiles as it is; with any of the MIX_ macros one line has its frames
// mixed and must not compile (tests/compile/CMakeLists.txt).
#include "cairn/geometry/camera_pose.h"
#include "cairn/geometry/rectification.h"
#include "cairn/sequence/trajectory.h"

namespace cairn {

Rigid3 compose(const CameraFromWorld& camera_from_world, const WorldFromCamera& world_from_camera) {
#ifdef MIX_COMPOSITION
  return camera_from_world * world_from_camera.inverse();
#else
  return camera_from_world * world_from_camera;
#endif
}

PoseEstimate pose_from(const StampedPose& start, const Rig& rig, const Correspondences& correspondences) {
#ifdef MIX_ARGUMENT
  return estimate_pose(rig, correspondences, start.world_from_camera);
#else
  return estimate_pose(rig, correspondences, start.world_from_camera.inverse());
#endif
}

StampedPose stamped(const PoseEstimate& estimate) {
#ifdef MIX_MEMBER
  return {0, estimate.camera_from_world};
#else
  return {0, estimate.camera_from_world.inverse()};
#endif
}

StereoPair pair_of(const Camera& left, const Camera& right, const Rigid3& right_from_left) {
  const Transform<frame::Right, frame::Left> named(right_from_left);
#ifdef MIX_CONVERSION
  return {left, right, LeftFromRight(named)};
#elif defined MIX_UNNAMED
  return {left, right, Rigid3(named.inverse())};
#else
  return {left, right, named.inverse()};
#endif
}

}  // namespace cairn
