// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "cairn/core/stopwatch.h"
#include "cairn/dense/fuse_sequence.h"
#include "common.h"
#include "pose_arguments.h"

namespace cairn::app {

/// What `cairn cloud` and `cairn octree` have in common: a sequence, its poses, and what became of its
/// frames.
struct PosedSequence {
  Sequence sequence;
  std::vector<std::optional<WorldFromCamera>> world_from_camera;
};

[[nodiscard]] PosedSequence open_posed_sequence(const SequenceArguments& arguments,
                                                const PoseArguments& poses);

}  // namespace cairn::app
