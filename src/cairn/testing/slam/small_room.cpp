// SPDX-License-Identifier: Apache-2.0
#include "cairn/testing/slam/small_room.h"

#include <algorithm>
#include <cmath>

#include "cairn/core/executor.h"
#include "cairn/core/progress.h"
#include "cairn/simulate/simulate_room.h"
#include "cairn/simulate/write_tum.h"

namespace cairn::testkit {

void write_small_room(const std::filesystem::path& folder, int frames) {
  SimulateRoomOptions options;
  options.frames_count = frames;
  options.camera = {CameraModel::pinhole, 320, 240, 262.5, 262.5, 159.5, 119.5, {}};
  const Executor executor(2);
  Progress silent;
  (void)write_tum(SimulatedRoom(options, executor), folder, executor, silent);
}

double error_m(const Sequence& sequence, const SlamResult& result) {
  const Rigid3 first_from_world = sequence.truth->front().world_from_camera.inverse();
  double sum = 0;
  const Trajectory trajectory = result.trajectory();
  for (const StampedPose& pose : trajectory) {
    const auto same_time = [&](const StampedPose& truth) { return truth.stamp_ns == pose.stamp_ns; };
    const auto truth = std::find_if(sequence.truth->begin(), sequence.truth->end(), same_time);
    sum += ((first_from_world * truth->world_from_camera).translation - pose.world_from_camera.translation)
               .squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(trajectory.size()));
}

}  // namespace cairn::testkit
