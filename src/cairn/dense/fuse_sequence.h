// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "cairn/core/executor.h"
#include "cairn/core/progress.h"
#include "cairn/dense/cloud.h"
#include "cairn/dense/occupancy.h"
#include "cairn/sequence/sequence.h"

namespace cairn {

/// Counts what became of a sequence's frames.
struct FusionReport {
  std::int64_t frames = 0;         ///< frames of the sequence
  std::int64_t fused = 0;          ///< frames with pose and images
  std::int64_t without_pose = 0;   ///< frames left out for want of a pose
  std::int64_t without_depth = 0;  ///< frames left out for want of a depth image
  std::int64_t unreadable = 0;     ///< frames left out with a warning, because an image cannot be read
  bool stopped = false;            ///< the user asked to stop; the result is complete up to there
};

/// Refers to the maps that frames are fused into; null for what is not wanted.
struct FusionTargets {
  CloudBuilder* cloud = nullptr;
  OccupancyGrid* occupancy = nullptr;
};

/// Decodes each frame with a pose once, in parallel, and fuses it in the order of the frames; the result is
/// the same at any number of threads. `world_from_camera` has one element for each frame of the sequence. A
/// frame whose images cannot be read is reported by progress.warn and left out. Throws InputError if the
/// sequence has no depth, no frame has a pose, or none of them can be read.
FusionReport fuse_sequence(const Sequence& sequence,
                           const std::vector<std::optional<WorldFromCamera>>& world_from_camera,
                           const FusionTargets& targets, const Executor& executor, Progress& progress);

}  // namespace cairn
