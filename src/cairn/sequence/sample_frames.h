// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "cairn/core/id.h"

namespace cairn {

/// Chooses up to `wanted` of the `count` frames of a recording, evenly from the first to the last, the first
/// one first: what a look at the recording as a whole needs to decode.
[[nodiscard]] std::vector<FrameId> sample_frames(std::size_t count, std::size_t wanted);

}  // namespace cairn
