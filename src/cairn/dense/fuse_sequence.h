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

/// What became of a sequence's frames.
struct FusionReport {
  std::int64_t frames = 0;         ///< of the sequence
  std::int64_t fused = 0;          ///< with pose and images
  std::int64_t without_pose = 0;   ///< left out
  std::int64_t without_depth = 0;  ///< left out
  std::int64_t unreadable = 0;     ///< left out, each with a warning
  bool stopped = false;            ///< the user asked to stop: what was done is complete up to there
};

/// Where frames are fused into; null for what is not wanted.
struct FusionTargets {
  CloudBuilder* cloud = nullptr;
  OccupancyGrid* occupancy = nullptr;
};

/// Decodes each frame with a pose once, in parallel, and fuses it in the order of the frames; the result is
/// the same at any number of threads. `world_from_camera` has one element for each frame of the sequence. A
/// frame whose images cannot be read is reported by progress.warn and left out. InputError where the sequence
/// has no depth, no frame has a pose, or none of them can be read.
FusionReport fuse_sequence(const Sequence& sequence,
                           const std::vector<std::optional<WorldFromCamera>>& world_from_camera,
                           const FusionTargets& targets, const Executor& executor, Progress& progress);

}  // namespace cairn
